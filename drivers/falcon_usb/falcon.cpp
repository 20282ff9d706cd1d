#include "drivers/falcon_usb/falcon.h"

#include <algorithm>
#include <cmath>

#include "drivers/falcon_usb/falcon_trouble.h"

namespace tactus::drivers {

namespace {

constexpr std::uint32_t kFalconBlockedToLoss = 3;
constexpr hal::TimeNs kFalconRequestPatience_ns = 20'000'000;
constexpr hal::TimeNs kFalconFarewellPatience_ns = 20'000'000;

}  // namespace

Falcon::Falcon(hal::UsbEndpoint& endpoint, const hal::Clock& clock, const FalconConfig& config)
    : endpoint_(&endpoint),
      clock_(&clock),
      config_(config),
      bring_up_(config.firmware),
      rates_{RateFilter(config.velocity_cutoff_Hz), RateFilter(config.velocity_cutoff_Hz),
             RateFilter(config.velocity_cutoff_Hz)} {}

Falcon::~Falcon() {
  withdraw_all();
}

void Falcon::start() {
  withdraw_all();
  reader_.restart();
  next_read_ = 0;
  sent_ = 0;
  answered_ = 0;
  payload_bytes_ = 0;
  samples_ = {};
  homed_ = false;
  reference_lost_ = false;
  homed_in_a_row_ = 0;
  bad_score_ = 0;
  blocked_in_a_row_ = 0;
  buttons_ = 0;
  motors_ = {};
  latched_ = kDeviceOk;
  trouble_ = {};
  if (!config_.unproven_watchdog) {
    latch(kDeviceDriveFault, kFalconNoWatchdog);
    state_ = State::stopped;
    return;
  }
  state_ = State::coming_up;
  bring_up_.start(clock_->now_ns());
  for (Read& read : reads_) {
    submit(read.transfer);
  }
}

void Falcon::clear_faults() {
  if (latched_ == kDeviceOk && state_ != State::stopped) {
    return;
  }
  const bool was_homed = homed_ || reference_lost_;
  if (endpoint_->state() == hal::UsbState::returned) {
    (void)endpoint_->reopen();  // if it fails, `start` reports it
  }
  start();
  reference_lost_ = was_homed;
}

void Falcon::stop() {
  if (state_ == State::running) {
    check_writes();
    Write& write = writes_[next_write_];
    send({.motor = {}, .lights = {.red = true}});
    (void)endpoint_->wait(write.transfer, clock_->now_ns() + kFalconFarewellPatience_ns);
  }
  withdraw_all();
  state_ = State::stopped;
}

void Falcon::withdraw_all() {
  for (Read& read : reads_) {
    endpoint_->cancel(read.transfer);
  }
  for (Write& write : writes_) {
    endpoint_->cancel(write.transfer);
    write.on_its_way = false;
  }
}

void Falcon::read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
  fresh_ = false;
  payload_ = false;
  doubt_ = {};
  if ((latched_ & kDeviceLost) != 0) {
    if (endpoint_->state() != hal::UsbState::attached) {
      trouble_ = kFalconUnplugged;
    }
    drain();
  } else if (state_ == State::coming_up) {
    come_up(deadline_ns);
  } else if (state_ == State::running) {
    exchange(deadline_ns);
  }
  const std::uint32_t now_status = status();
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    samples_[arm].status = now_status;
    samples[arm] = samples_[arm];
  }
}

std::uint32_t Falcon::status() const {
  const std::uint32_t lost = reference_lost_ ? kDeviceReferenceLost : kDeviceOk;
  if (state_ != State::running) {
    return latched_ | lost | kDeviceNotReady;
  }
  return latched_ | lost | (homed_ ? kDeviceOk : kDeviceHoming) |
         (fresh_ ? kDeviceOk : kDeviceStale);
}

Trouble Falcon::trouble(std::size_t /*axis*/) const {
  return trouble_;
}

void Falcon::latch(std::uint32_t status, const Trouble& trouble) {
  latched_ |= status | (homed_ ? kDeviceReferenceLost : kDeviceOk);
  if (!trouble_) {
    trouble_ = trouble;
  }
}

void Falcon::lose(const hal::Error& error) {
  Trouble trouble =
      error.code == hal::ErrorCode::disconnected || error.code == hal::ErrorCode::invalid_state
          ? kFalconUnplugged
          : kFalconTransferFailed;
  trouble.code = static_cast<std::uint32_t>(-error.errno_value);
  latch(kDeviceLost, trouble);
}

void Falcon::come_up(hal::TimeNs deadline_ns) {
  const hal::TimeNs now_ns = clock_->now_ns();
  drain();
  while (act(bring_up_.next(now_ns))) {
  }
  (void)receive(deadline_ns);
  note_outcome();
}

// Carries the action out. Returns true if there may be another one at once.
bool Falcon::act(const FalconBringUp::Action& action) {
  using Kind = FalconBringUp::Action::Kind;
  if (action.kind == Kind::nothing || latched_ != kDeviceOk) {
    return false;
  }
  const hal::TimeNs by_ns = clock_->now_ns() + kFalconRequestPatience_ns;
  const auto done = action.kind == Kind::control ? endpoint_->control_out(action.setup, {}, by_ns)
                                                 : endpoint_->bulk_out(action.bytes, by_ns);
  if (done && (action.kind == Kind::control || *done == action.bytes.size())) {
    return action.kind == Kind::send;
  }
  if (!done && done.error().code != hal::ErrorCode::timeout &&
      done.error().code != hal::ErrorCode::stalled) {
    lose(done.error());
  }
  bring_up_.refused(clock_->now_ns());
  return false;
}

void Falcon::note_outcome() {
  if (bring_up_.outcome() == FalconBringUp::Outcome::up) {
    state_ = State::running;
    reader_.restart();
  } else if (const Trouble failed = trouble_of(bring_up_.outcome()); failed) {
    latch(kDeviceDriveFault, failed);
  }
}

void Falcon::write(std::span<const AxisCommand> commands) {
  if (state_ != State::running) {
    return;
  }
  check_writes();
  const bool allowed = latched_ == kDeviceOk && homed_;
  FalconCommand command;
  bool powered = false;
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    command.motor[arm] = allowed ? motor_units(commands[arm]) : std::int16_t{0};
    powered = powered || (allowed && commands[arm].enable);
  }
  command.lights = lights(powered);
  send(command);
}

// Returns the motor units of a torque. A positive motor value pulls the arm toward the base,
// according to both sources.
std::int16_t Falcon::motor_units(const AxisCommand& command) const {
  if (!command.enable || !std::isfinite(command.torque_Nm)) {
    return 0;
  }
  const double torque_Nm =
      std::clamp(command.torque_Nm, -config_.torque_limit_Nm, config_.torque_limit_Nm);
  const double limit = kFalconMotorLimit;
  const double units = std::clamp(-config_.motor_units_per_Nm * torque_Nm, -limit, limit);
  return static_cast<std::int16_t>(units);
}

FalconLights Falcon::lights(bool powered) const {
  const bool well = homed_ && latched_ == kDeviceOk;
  return {.red = !well, .green = well && !powered, .blue = well && powered};
}

// Checks the outcomes of the packets that were sent before.
void Falcon::check_writes() {
  for (Write& write : writes_) {
    if (!write.on_its_way) {
      continue;
    }
    const auto sent = endpoint_->wait(write.transfer, hal::kNoWait);
    write.on_its_way = write.transfer.state() == hal::UsbTransfer::State::in_flight;
    if (!sent && !write.on_its_way) {
      lose(sent.error());
    }
  }
}

void Falcon::send(const FalconCommand& command) {
  Write& write = writes_[next_write_];
  if (write.on_its_way) {
    ++blocked_in_a_row_;
    if (blocked_in_a_row_ >= kFalconBlockedToLoss) {
      latch(kDeviceLost, kFalconNotTaking);
    }
    return;
  }
  blocked_in_a_row_ = 0;
  write.packet = encode(command);
  motors_ = command.motor;
  if (sent_ - answered_ == kRemembered) {
    ++answered_;
  }
  sent_ns_[sent_ % kRemembered] = clock_->now_ns();
  ++sent_;
  next_write_ = (next_write_ + 1) % writes_.size();
  write.on_its_way = true;
  submit(write.transfer);
}

void Falcon::submit(hal::UsbTransfer& transfer) {
  if (const auto submitted = endpoint_->submit(transfer); !submitted) {
    lose(submitted.error());
  }
}

}  // namespace tactus::drivers
