#include "host_tools/emulators/gpio_axis_emulator.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tactus::host {

namespace {

// Under the fault `corrupted`, the mean number of runs between skipped counts. A skip of two counts
// changes both channels.
constexpr unsigned kRunsBetweenGlitches = 50;

// Channels A and B (bits 1 and 0) in the order of forward counts, with A leading.
constexpr std::array<unsigned, 4> kStates{0b00, 0b10, 0b11, 0b01};

// Returns the remainder in [0, by), also of a negative value.
std::int64_t floor_mod(std::int64_t value, std::int64_t by) {
  return ((value % by) + by) % by;
}

}  // namespace

GpioAxisEmulator::GpioAxisEmulator(const drivers::GpioAxisConfig& axis, BoardPins& pins,
                                   std::uint32_t seed, std::uint32_t steps_per_run)
    : axis_(axis), pins_(pins), random_(seed), encoder_{.steps_per_run = steps_per_run} {
  show(encoder_.count);
  drive(axis_.pins.fault, false);
  open_emergency_stop(false);
  open_limit_low(false);
  open_limit_high(false);
}

void GpioAxisEmulator::set_fault(EmulatorFault fault) {
  if (fault_.is(fault) || fault_.is(EmulatorFault::unplugged)) {
    return;
  }
  if (fault_.is(EmulatorFault::silent)) {
    encoder_.count = wanted_count();
    show(encoder_.count);
  }
  fault_.set(fault);
  drive(axis_.pins.fault, fault == EmulatorFault::erroring);
  if (fault == EmulatorFault::unplugged) {
    pins_.unplug();
  }
}

void GpioAxisEmulator::open_emergency_stop(bool open) {
  chain_open_ = open;
  drive(axis_.pins.emergency_stop, open);
}

void GpioAxisEmulator::open_limit_low(bool open) {
  drive(axis_.pins.limit_low, open);
}

void GpioAxisEmulator::open_limit_high(bool open) {
  drive(axis_.pins.limit_high, open);
}

void GpioAxisEmulator::run(hal::TimeNs now_ns) {
  encoder_.past.push_back({.time_ns = now_ns, .position_rad = shaft_.position_rad});
  while (encoder_.past.size() > 1 && encoder_.past[1].time_ns <= now_ns - kFaultDelay_ns) {
    encoder_.past.pop_front();
  }
  if (fault_.is(EmulatorFault::unplugged)) {
    shaft_.torque_Nm = 0.0;
    return;
  }
  follow_power(now_ns);
  if (!fault_.is(EmulatorFault::silent) && !is_off_) {
    move_encoder();
  }
  watch_heartbeat(now_ns);
  shaft_.torque_Nm = is_off_ ? 0.0 : motor_torque(now_ns);
}

void GpioAxisEmulator::follow_power(hal::TimeNs now_ns) {
  const bool was_off = is_off_;
  is_off_ = !fault_.has_power(now_ns);
  if (was_off && !is_off_) {
    encoder_.count = wanted_count();
    show(encoder_.count);
  }
}

std::int64_t GpioAxisEmulator::wanted_count() const {
  const bool late = fault_.is(EmulatorFault::delayed) && !encoder_.past.empty();
  const double position_rad = late ? encoder_.past.front().position_rad : shaft_.position_rad;
  const double sign = axis_.encoder.reversed ? -1.0 : 1.0;
  return std::llround(sign * position_rad * axis_.encoder.counts_per_rev /
                      (2.0 * std::numbers::pi));
}

void GpioAxisEmulator::move_encoder() {
  const std::int64_t wanted = wanted_count();
  for (std::uint32_t i = 0; i < encoder_.steps_per_run && encoder_.count != wanted; ++i) {
    encoder_.count += wanted > encoder_.count ? 1 : -1;
    show(encoder_.count);
  }
  if (fault_.is(EmulatorFault::corrupted) && random_() % kRunsBetweenGlitches == 0) {
    encoder_.count += 2;
    show(encoder_.count);
  }
}

// The index ends before the channels leave its state and begins after they have entered it, so that
// no edge shows an index in a wrong state.
void GpioAxisEmulator::show(std::int64_t count) {
  const unsigned state = kStates[static_cast<std::size_t>(floor_mod(count, 4))];
  const auto in_turn = floor_mod(count, axis_.encoder.counts_per_rev);
  const bool index = in_turn < 4 && state == axis_.encoder.index_state;
  if (!index) {
    drive(axis_.pins.encoder_index, false);
  }
  drive(axis_.pins.encoder_a, (state & 2U) != 0);
  drive(axis_.pins.encoder_b, (state & 1U) != 0);
  if (index) {
    drive(axis_.pins.encoder_index, true);
  }
}

void GpioAxisEmulator::watch_heartbeat(hal::TimeNs now_ns) {
  const bool level = is_active(axis_.pins.heartbeat);
  if (level != heartbeat_.level) {
    heartbeat_.level = level;
    heartbeat_.edge_ns = now_ns;
  }
}

// Locked antiphase: 50 % duty is no torque. Sign and magnitude: a line gives the direction. A
// bridge with the square-root law makes a torque that grows with the square of the duty.
double GpioAxisEmulator::motor_torque(hal::TimeNs now_ns) {
  const bool beats = !axis_.pins.heartbeat ||
                     (heartbeat_.edge_ns != 0 && now_ns - heartbeat_.edge_ns < kHeartbeat_ns);
  const bool enabled = !axis_.pins.enable || is_active(axis_.pins.enable);
  if (!beats || !enabled || chain_open_ || fault_.is(EmulatorFault::erroring)) {
    return 0.0;
  }
  const drivers::BridgeConfig& bridge = axis_.bridge;
  const double high = pins_.pwm_level();
  double part = high;
  if (bridge.mode == drivers::BridgeMode::locked_antiphase) {
    part = 2.0 * high - 1.0;
  } else if (is_active(axis_.pins.direction)) {
    part = -high;
  }
  if (bridge.law == drivers::TorqueLaw::square_root) {
    part *= std::abs(part);
  }
  return (bridge.reversed ? -part : part) * bridge.full_duty_torque_Nm;
}

bool GpioAxisEmulator::brake_is_closed() {
  return axis_.pins.brake_release.has_value() && !is_active(axis_.pins.brake_release);
}

void GpioAxisEmulator::drive(const std::optional<drivers::InputPin>& pin, bool active) {
  if (pin) {
    pins_.drive(pin->offset, active != pin->active_low);
  }
}

bool GpioAxisEmulator::is_active(const std::optional<drivers::OutputPin>& pin) {
  return pin.has_value() && pins_.level(pin->offset) != pin->active_low;
}

}  // namespace tactus::host
