// The part of Falcon that takes the device's answers. It checks when they come, and whether they
// are possible.
#include "drivers/falcon_usb/falcon.h"
#include "drivers/falcon_usb/falcon_trouble.h"

namespace tactus::drivers {

namespace {

// The origin moves when the reference is found, so it is trusted after so many equal answers.
constexpr std::uint32_t kFalconHomedToBelieve = 8;
constexpr std::size_t kFalconPacketsATick = 16;

}  // namespace

void Falcon::drain() {
  for (std::size_t i = 0; i < kFalconPacketsATick && receive(hal::kNoWait); ++i) {
  }
}

void Falcon::exchange(hal::TimeNs deadline_ns) {
  const bool awaited = answers_.is_awaited();
  drain();
  for (std::size_t i = 0;
       i < kFalconPacketsATick && awaited && !this_read_.is_fresh && !this_read_.doubt; ++i) {
    if (!receive(deadline_ns)) {
      break;
    }
  }
  if (awaited || this_read_.doubt) {
    judge();
  }
}

void Falcon::judge() {
  if (this_read_.is_fresh) {
    score_.good();
    return;
  }
  if (!score_.bad()) {
    return;
  }
  if (this_read_.doubt) {
    latch(kDeviceEncoderFault, this_read_.doubt);
  } else if (this_read_.has_bytes) {
    latch(kDeviceEncoderFault, kFalconGarbled);
  } else {
    latch(kDeviceLost, kFalconSilent);
  }
}

bool Falcon::receive(hal::TimeNs deadline_ns) {
  const auto received = link_.receive(deadline_ns);
  if (!received) {
    lose(received.error());
    return false;
  }
  const auto& bytes = *received;
  if (!bytes) {
    return false;
  }
  take(ftdi_payload(*bytes));
  check(link_.read_on());
  return true;
}

void Falcon::take(std::span<const std::byte> payload) {
  if (state_ != State::running) {
    bring_up_.take(payload, clock_->now_ns());
    return;
  }
  this_read_.has_bytes = this_read_.has_bytes || !payload.empty();
  for (const std::byte byte : payload) {
    if (const auto answer = answers_.take(byte)) {
      accept(*answer);
    }
  }
}

void Falcon::accept(const FalconAnswer& answer) {
  if (faults_ || !answers_.has_asked()) {
    return;
  }
  const FalconReply& reply = answer.reply;
  if (!homing_.is_done) {
    home_with(answer);
  } else if (!reply.all_homed()) {
    this_read_.doubt = kFalconReferenceLost;
  } else if (!arms_.can_reach(reply.counts, answer.asked_ns)) {
    this_read_.doubt = kFalconJumped;
  } else {
    believe(answer);
  }
}

void Falcon::home_with(const FalconAnswer& answer) {
  const FalconReply& reply = answer.reply;
  const bool is_steady = homing_.in_a_row == 0 || arms_.can_reach(reply.counts, answer.asked_ns);
  homing_.in_a_row = reply.all_homed() && is_steady ? homing_.in_a_row + 1 : 0;
  homing_.is_done = homing_.in_a_row >= kFalconHomedToBelieve;
  homing_.is_reference_lost = homing_.is_reference_lost && !homing_.is_done;
  believe(answer);
}

void Falcon::believe(const FalconAnswer& answer) {
  this_read_.is_fresh = true;
  newest_.buttons = answer.reply.buttons;
  if (homing_.in_a_row == 0) {
    arms_.restart_velocities();
  }
  arms_.take(answer.reply.counts, answer.asked_ns);
}

}  // namespace tactus::drivers
