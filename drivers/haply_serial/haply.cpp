#include "drivers/haply_serial/haply.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// A read without a possible answer adds kHaplyBadRead, a good one subtracts 1. Three bad reads in a
// row are a fault, and so is a long run of which a quarter is bad.
constexpr std::uint32_t kHaplyBadRead = 3;
constexpr std::uint32_t kHaplyFaultScore = 9;
constexpr std::uint32_t kHaplyAnswersToBelieve = 3;
constexpr std::uint32_t kHaplyReadsForAnAnswer = 2;
constexpr double kHaplySlack_rad = 0.002;
constexpr hal::TimeNs kHaplyLongestGap_ns = 10'000'000;
constexpr hal::TimeNs kHaplySettling_ns = 20'000'000;
constexpr hal::TimeNs kHaplyWritePatience_ns = 20'000'000;
constexpr std::size_t kHaplyAnswersATick = 16;
// The angles that the first setup tells a board differ from home_rad by at least so many
// tolerances. They differ from each other and from start to start by fractions of one.
constexpr double kHaplyAskedTolerances = 5.0;
constexpr std::uint32_t kHaplyAskedSteps = 11;

constexpr Trouble kHaplyUnplugged{
    .what = "the Haply board is unplugged",
    .remedy = "plug it in, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplyTransferFailed{
    .what = "a transfer to the Haply board failed",
    .remedy = "check the cable, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplyNotTaking{
    .what = "the Haply board takes no more commands",
    .remedy = "unplug it and plug it in, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplySilent{
    .what = "the Haply board does not answer",
    .remedy = "check its power supply, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplyGarbled{
    .what = "the Haply board's answers make no sense",
    .remedy = "check the device id and the cable, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplyJumped{
    .what = "the Haply's arms seem to jump",
    .remedy = "check the encoders' cables, reset, put the arms in their home pose and home"};
constexpr Trouble kHaplySetupWrong{
    .what = "the Haply board did not take its setup",
    .remedy = "check that the port and the device id are the board's, keep the arms still, reset"};
constexpr Trouble kHaplyNoWatchdog{
    .what = "the Haply board keeps its torque when the host dies: it has no watchdog",
    .remedy =
        "put a switch within reach that cuts its motor supply, and say unproven_watchdog = "
        "true at its connection"};

}  // namespace

Haply::Haply(hal::SerialPort& port, const hal::Clock& clock, const HaplyConfig& config)
    : port_(&port),
      clock_(&clock),
      config_(config),
      rates_{RateFilter(config.velocity_cutoff_Hz), RateFilter(config.velocity_cutoff_Hz),
             RateFilter(config.velocity_cutoff_Hz), RateFilter(config.velocity_cutoff_Hz)} {
  config_.axes = std::clamp<std::size_t>(config_.axes, 1, kHaplyMaxAxes);
}

void Haply::start() {
  ++starts_;
  samples_ = {};
  bad_score_ = 0;
  latched_ = kDeviceOk;
  trouble_ = {};
  set_up_ = false;
  reference_lost_ = false;
  identity_ = Identity::asked;
  if (!config_.unproven_watchdog) {
    latch(kDeviceDriveFault, kHaplyNoWatchdog);
    state_ = State::stopped;
    return;
  }
  set_up();
}

void Haply::forget_answers() {
  reply_size_ = 0;
  reply_late_ = 0;
  sent_ = 0;
  answered_ = 0;
  believed_ = {};
  reference_ = {};
  at_home_in_a_row_ = 0;
}

// Returns the angle that the setup tells the axis to count from, rad.
double Haply::told_rad(std::size_t axis) const {
  const double home_rad = config_.axis[axis].home_rad;
  if (identity_ == Identity::shown) {
    return home_rad;
  }
  const auto step = static_cast<double>((std::size_t{starts_} * 7 + axis * 3) % kHaplyAskedSteps);
  return home_rad + (kHaplyAskedTolerances + step) * config_.home_tolerance_rad;
}

void Haply::set_up() {
  forget_answers();
  state_ = State::settling;
  std::array<HaplyAxisSetup, kHaplyMaxAxes> axes;
  for (std::size_t i = 0; i < config_.axes; ++i) {
    const HaplyAxisConfig& axis = config_.axis[i];
    axes[i] = {.motor_counter_clockwise = axis.motor_counter_clockwise,
               .encoder_counter_clockwise = axis.encoder_counter_clockwise,
               .counts_per_turn = axis.counts_per_turn,
               .angle_now_rad = told_rad(i)};
    rates_[i].restart();
  }
  const std::uint8_t id = config_.device_id;
  const hal::TimeNs by_ns = clock_->now_ns() + kHaplyWritePatience_ns;
  const Torques none{};
  // A reset leaves the motors' torque as it is, so zero is sent before it.
  (void)(send(haply_torques(id, std::span(none).first(config_.axes)), by_ns) &&
         send(haply_reset(id), by_ns) &&
         send(haply_setup(id, std::span(axes).first(config_.axes)), by_ns));
  settled_ns_ = clock_->now_ns() + kHaplySettling_ns;
}

void Haply::clear_faults() {
  if (latched_ == kDeviceOk && state_ != State::stopped) {
    return;
  }
  const bool was_set_up = set_up_ || reference_lost_;
  if ((latched_ & kDeviceLost) != 0) {
    (void)port_->reopen();  // if it fails, `start` reports it
  }
  start();
  reference_lost_ = was_set_up;
}

void Haply::stop() {
  const hal::TimeNs by_ns = clock_->now_ns() + kHaplyWritePatience_ns;
  const Torques none{};
  if (state_ != State::stopped &&
      send(haply_torques(config_.device_id, std::span(none).first(config_.axes)), by_ns)) {
    (void)send(haply_reset(config_.device_id), by_ns);
  }
  state_ = State::stopped;
}

void Haply::read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
  fresh_ = false;
  unasked_ = false;
  doubt_ = {};
  if (state_ == State::settling && clock_->now_ns() >= settled_ns_) {
    if (const auto discarded = port_->discard_input(); !discarded) {
      lose(discarded.error());
    }
    state_ = State::running;
  } else if (state_ == State::running) {
    exchange(deadline_ns);
  }
  const std::uint32_t now_status = status();
  for (std::size_t i = 0; i < config_.axes; ++i) {
    samples_[i].status = now_status;
    samples[i] = samples_[i];
  }
}

std::uint32_t Haply::status() const {
  if (state_ != State::running || !set_up_) {
    return latched_ | kDeviceNotReady | (reference_lost_ ? kDeviceReferenceLost : kDeviceOk);
  }
  return latched_ | (fresh_ ? kDeviceOk : kDeviceStale);
}

Trouble Haply::trouble(std::size_t /*axis*/) const {
  return trouble_;
}

void Haply::latch(std::uint32_t status, const Trouble& trouble) {
  latched_ |= status | (set_up_ ? kDeviceReferenceLost : kDeviceOk);
  if (!trouble_) {
    trouble_ = trouble;
  }
}

void Haply::lose(const hal::Error& error) {
  Trouble trouble = kHaplyTransferFailed;
  if (error.code == hal::ErrorCode::disconnected) {
    trouble = kHaplyUnplugged;
  } else if (error.code == hal::ErrorCode::timeout) {
    trouble = kHaplyNotTaking;
  }
  trouble.code = static_cast<std::uint32_t>(error.errno_value);
  latch(kDeviceLost, trouble);
}

void Haply::exchange(hal::TimeNs deadline_ns) {
  const bool awaited = sent_ != answered_;
  for (std::size_t i = 0; i < kHaplyAnswersATick && receive(hal::kNoWait); ++i) {
  }
  if (awaited && !fresh_ && !doubt_) {
    (void)receive(deadline_ns);
  }
  drop_late_piece();
  if (awaited || doubt_) {
    judge();
  }
}

bool Haply::receive(hal::TimeNs deadline_ns) {
  if ((latched_ & kDeviceLost) != 0) {
    return false;
  }
  const std::size_t whole = haply_reply_bytes(config_.axes);
  const auto got =
      port_->read_all(std::span(reply_).subspan(reply_size_, whole - reply_size_), deadline_ns);
  if (!got) {
    if (got.error().code != hal::ErrorCode::timeout) {
      lose(got.error());
    }
    return false;
  }
  reply_size_ += *got;
  if (reply_size_ < whole) {
    return false;
  }
  reply_size_ = 0;
  reply_late_ = 0;
  if (answered_ == sent_) {
    unasked_ = true;
    doubt_ = kHaplyGarbled;
    return true;
  }
  answer_ns_ = sent_ns_[answered_ % kRemembered];
  ++answered_;
  if (const auto angles =
          decode_haply_reply(std::span(reply_).first(whole), config_.device_id, config_.axes)) {
    accept(*angles);
  } else {
    doubt_ = kHaplyGarbled;
    (void)port_->discard_input();  // the next byte may be in the middle of an answer
  }
  return true;
}

// Drops a part of an answer that came late. A board that lost its setup sends answers that are too
// short, and they must not add up to a whole one.
void Haply::drop_late_piece() {
  reply_late_ = reply_size_ > 0 ? reply_late_ + 1 : 0;
  if (reply_late_ < kHaplyReadsForAnAnswer) {
    return;
  }
  reply_size_ = 0;
  reply_late_ = 0;
  if (answered_ != sent_) {
    ++answered_;
  }
  doubt_ = kHaplyGarbled;
  (void)port_->discard_input();
}

void Haply::accept(const HaplyAngles& angles) {
  if (latched_ != kDeviceOk || sent_ == 0) {
    return;
  }
  if (!set_up_) {
    find_home(angles);
  } else if (!moved_plausibly(angles)) {
    doubt_ = kHaplyJumped;
  } else {
    believe(angles);
  }
}

// Identifies a board by answers that follow the setup twice, with different angles. A line that
// repeats one message, or echoes, cannot do both.
void Haply::find_home(const HaplyAngles& angles) {
  if (!says_what_it_was_told(angles) || (at_home_in_a_row_ > 0 && !moved_plausibly(angles))) {
    at_home_in_a_row_ = 0;
    doubt_ = kHaplySetupWrong;
    return;
  }
  ++at_home_in_a_row_;
  believe(angles);
  if (at_home_in_a_row_ < kHaplyAnswersToBelieve) {
    return;
  }
  if (identity_ == Identity::asked) {
    identity_ = Identity::shown;
    set_up();
    return;
  }
  set_up_ = true;
  reference_lost_ = false;
}

bool Haply::says_what_it_was_told(const HaplyAngles& angles) const {
  for (std::size_t i = 0; i < config_.axes; ++i) {
    if (std::abs(angles[i] - told_rad(i)) > config_.home_tolerance_rad) {
      return false;
    }
  }
  return true;
}

bool Haply::moved_plausibly(const HaplyAngles& angles) const {
  const Believed& from = answer_ns_ != believed_.time_ns ? believed_ : reference_;
  const hal::TimeNs gap_ns =
      std::clamp<hal::TimeNs>(answer_ns_ - from.time_ns, 0, kHaplyLongestGap_ns);
  const double reach_rad =
      kHaplySlack_rad + config_.fastest_rad_per_s * static_cast<double>(gap_ns) * 1e-9;
  for (std::size_t i = 0; i < config_.axes; ++i) {
    if (std::abs(angles[i] - from.angles[i]) > reach_rad) {
      return false;
    }
  }
  return true;
}

void Haply::believe(const HaplyAngles& angles) {
  fresh_ = true;
  if (answer_ns_ != believed_.time_ns) {
    reference_ = believed_;
  }
  believed_ = {.angles = angles, .time_ns = answer_ns_};
  for (std::size_t i = 0; i < config_.axes; ++i) {
    samples_[i].position_rad = angles[i];
    samples_[i].velocity_rad_per_s =
        std::clamp(rates_[i].update(angles[i], answer_ns_), -config_.fastest_rad_per_s,
                   config_.fastest_rad_per_s);
    samples_[i].time_ns = answer_ns_;
  }
}

void Haply::judge() {
  if (fresh_ && !unasked_) {
    bad_score_ -= bad_score_ > 0 ? 1 : 0;
    return;
  }
  bad_score_ += kHaplyBadRead;
  if (bad_score_ < kHaplyFaultScore) {
    return;
  }
  if (doubt_) {
    latch(kDeviceEncoderFault, doubt_);
  } else {
    latch(kDeviceLost, kHaplySilent);
  }
}

void Haply::write(std::span<const AxisCommand> commands) {
  if (state_ != State::running) {
    return;
  }
  const bool allowed = latched_ == kDeviceOk && set_up_;
  Torques torque_Nm{};
  for (std::size_t i = 0; i < config_.axes; ++i) {
    if (allowed && commands[i].enable && std::isfinite(commands[i].torque_Nm)) {
      torque_Nm[i] =
          std::clamp(commands[i].torque_Nm, -config_.torque_limit_Nm, config_.torque_limit_Nm);
    }
  }
  send_torques(torque_Nm);
}

void Haply::send_torques(const Torques& torque_Nm) {
  if (sent_ - answered_ == kRemembered) {
    ++answered_;
  }
  sent_ns_[sent_ % kRemembered] = clock_->now_ns();
  ++sent_;
  send(haply_torques(config_.device_id, std::span(torque_Nm).first(config_.axes)), hal::kNoWait);
}

// Sends the whole message, or counts the board as lost: the rest of a partial one would be read as
// another command.
bool Haply::send(const HaplyMessage& message, hal::TimeNs deadline_ns) {
  const auto taken = port_->write(message.bytes(), deadline_ns);
  if (taken && *taken == message.bytes().size()) {
    return true;
  }
  lose(taken ? hal::Error{hal::ErrorCode::timeout, 0} : taken.error());
  return false;
}

}  // namespace tactus::drivers
