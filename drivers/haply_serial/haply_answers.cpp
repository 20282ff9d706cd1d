// The part of Haply that takes the board's answers. It checks when they come, and whether they are
// possible.
#include <cmath>

#include "drivers/haply_serial/haply.h"
#include "drivers/haply_serial/haply_trouble.h"

namespace tactus::drivers {

namespace {

constexpr std::uint32_t kHaplyAnswersToBelieve = 3;
constexpr double kHaplySlack_rad = 0.002;
constexpr std::size_t kHaplyAnswersATick = 16;

}  // namespace

void Haply::exchange(hal::TimeNs deadline_ns) {
  const bool awaited = answers_.is_awaited();
  for (std::size_t i = 0; i < kHaplyAnswersATick && receive(hal::kNoWait); ++i) {
  }
  if (awaited && !reads_.is_fresh() && !reads_.doubt()) {
    (void)receive(deadline_ns);
  }
  drop_late_piece();
  if (awaited || reads_.doubt()) {
    judge();
  }
}

bool Haply::receive(hal::TimeNs deadline_ns) {
  if ((faults_.status() & kDeviceLost) != 0) {
    return false;
  }
  const auto got = port_->read_all(answers_.room(), deadline_ns);
  if (!got) {
    if (got.error().code != hal::ErrorCode::timeout) {
      lose(got.error());
    }
    return false;
  }
  const auto answer = answers_.take(*got);
  if (!answer) {
    return false;
  }
  if (answer->asked_ns) {
    take(answer->bytes, *answer->asked_ns);
  } else {
    reads_.doubt_unasked(kHaplyGarbled);
  }
  return true;
}

void Haply::take(std::span<const std::byte> reply, hal::TimeNs asked_ns) {
  if (const auto angles = decode_haply_reply(reply, config_.device_id, config_.axes)) {
    accept(*angles, asked_ns);
  } else {
    reads_.doubt(kHaplyGarbled);
    (void)port_->discard_input();  // the next byte may be in the middle of an answer
  }
}

// Drops a part of an answer that came late. A board that lost its setup sends answers that are too
// short, and they must not add up to a whole one.
void Haply::drop_late_piece() {
  if (answers_.drop_late_piece()) {
    reads_.doubt(kHaplyGarbled);
    (void)port_->discard_input();
  }
}

void Haply::accept(const HaplyAngles& angles, hal::TimeNs asked_ns) {
  if (faults_) {
    return;
  }
  if (!setup_.is_done) {
    find_home(angles, asked_ns);
  } else if (!moved_plausibly(angles, asked_ns)) {
    reads_.doubt(kHaplyJumped);
  } else {
    believe(angles, asked_ns);
  }
}

// Identifies a board by answers that follow the setup twice, with different angles. A line that
// repeats one message, or echoes, cannot do both.
void Haply::find_home(const HaplyAngles& angles, hal::TimeNs asked_ns) {
  if (!says_what_it_was_told(angles) ||
      (setup_.at_home_in_a_row > 0 && !moved_plausibly(angles, asked_ns))) {
    setup_.at_home_in_a_row = 0;
    reads_.doubt(kHaplySetupWrong);
    return;
  }
  ++setup_.at_home_in_a_row;
  believe(angles, asked_ns);
  if (setup_.at_home_in_a_row < kHaplyAnswersToBelieve) {
    return;
  }
  if (setup_.identity == Identity::asked) {
    setup_.identity = Identity::shown;
    set_up();
    return;
  }
  setup_.is_done = true;
  setup_.is_reference_lost = false;
}

bool Haply::says_what_it_was_told(const HaplyAngles& angles) const {
  for (std::size_t i = 0; i < config_.axes; ++i) {
    if (std::abs(angles[i] - told_rad(i)) > config_.home_tolerance_rad) {
      return false;
    }
  }
  return true;
}

bool Haply::moved_plausibly(const HaplyAngles& angles, hal::TimeNs asked_ns) const {
  const HaplyAngles& from = last_.before(asked_ns);
  const double reach_rad = kHaplySlack_rad + last_.reach_rad(config_.fastest_rad_per_s, asked_ns);
  for (std::size_t i = 0; i < config_.axes; ++i) {
    if (std::abs(angles[i] - from[i]) > reach_rad) {
      return false;
    }
  }
  return true;
}

void Haply::believe(const HaplyAngles& angles, hal::TimeNs asked_ns) {
  reads_.believe();
  last_.take(angles, asked_ns);
  for (std::size_t i = 0; i < config_.axes; ++i) {
    samples_.take(i, angles[i], asked_ns);
  }
}

void Haply::judge() {
  if (!reads_.end_in_fault()) {
    return;
  }
  if (reads_.doubt()) {
    latch(kDeviceEncoderFault, reads_.doubt());
  } else {
    latch(kDeviceLost, kHaplySilent);
  }
}

}  // namespace tactus::drivers
