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
    : clock_(&clock),
      config_(config),
      link_(endpoint),
      bring_up_(config.firmware),
      arms_(config.velocity_cutoff_Hz, config.fastest_rad_per_s) {}

void Falcon::start() {
  link_.withdraw_all();
  answers_.restart();
  arms_.forget();
  reads_ = {};
  newest_ = {};
  faults_.clear();
  if (!config_.unproven_watchdog) {
    latch(kDeviceDriveFault, kFalconNoWatchdog);
    state_ = State::stopped;
    return;
  }
  state_ = State::coming_up;
  bring_up_.start(clock_->now_ns());
  check(link_.start_reads());
}

void Falcon::clear_faults() {
  if (!faults_ && state_ != State::stopped) {
    return;
  }
  const bool was_homed = arms_.is_homed() || arms_.is_reference_lost();
  if (link_.endpoint().state() == hal::UsbState::returned) {
    (void)link_.endpoint().reopen();  // if it fails, `start` reports it
  }
  start();
  if (was_homed) {
    arms_.lose_reference();
  }
}

void Falcon::stop() {
  if (state_ == State::running) {
    check(link_.check_writes());
    const std::size_t place = link_.next_place();
    send({.motor = {}, .lights = {.red = true}});
    link_.wait_for(place, clock_->now_ns() + kFalconFarewellPatience_ns);
  }
  link_.withdraw_all();
  state_ = State::stopped;
}

void Falcon::read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
  reads_.begin();
  answers_.begin_read();
  if ((faults_.status() & kDeviceLost) != 0) {
    if (link_.endpoint().state() != hal::UsbState::attached) {
      faults_.explain(kFalconUnplugged);
    }
    drain();
  } else if (state_ == State::coming_up) {
    come_up(deadline_ns);
  } else if (state_ == State::running) {
    exchange(deadline_ns);
  }
  arms_.report(status(), samples);
}

std::uint32_t Falcon::status() const {
  const std::uint32_t latched =
      faults_.status() | (arms_.is_reference_lost() ? kDeviceReferenceLost : kDeviceOk);
  if (state_ != State::running) {
    return latched | kDeviceNotReady;
  }
  return latched | (arms_.is_homed() ? kDeviceOk : kDeviceHoming) |
         (reads_.is_fresh() ? kDeviceOk : kDeviceStale);
}

Trouble Falcon::trouble(std::size_t /*axis*/) const {
  return faults_.trouble();
}

void Falcon::latch(std::uint32_t status, const Trouble& trouble) {
  faults_.latch(status | (arms_.is_homed() ? kDeviceReferenceLost : kDeviceOk), trouble);
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
  if (action.kind == Kind::nothing || faults_) {
    return false;
  }
  const hal::TimeNs by_ns = clock_->now_ns() + kFalconRequestPatience_ns;
  const auto done = action.kind == Kind::control
                        ? link_.endpoint().control_out(action.setup, {}, by_ns)
                        : link_.endpoint().bulk_out(action.bytes, by_ns);
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
    answers_.resynchronize();
  } else if (const Trouble failed = trouble_of(bring_up_.outcome()); failed) {
    latch(kDeviceDriveFault, failed);
  }
}

void Falcon::write(std::span<const AxisCommand> commands) {
  if (state_ != State::running) {
    return;
  }
  check(link_.check_writes());
  const bool allowed = !faults_ && arms_.is_homed();
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
  const bool well = arms_.is_homed() && !faults_;
  return {.red = !well, .green = well && !powered, .blue = well && powered};
}

void Falcon::send(const FalconCommand& command) {
  if (!link_.has_room()) {
    if (link_.note_blocked() >= kFalconBlockedToLoss) {
      latch(kDeviceLost, kFalconNotTaking);
    }
    return;
  }
  newest_.motors = command.motor;
  answers_.ask(clock_->now_ns());
  check(link_.send(encode(command)));
}

void Falcon::check(const hal::Result<void>& outcome) {
  if (!outcome) {
    lose(outcome.error());
  }
}

}  // namespace tactus::drivers
