#include "drivers/haply_serial/haply.h"

#include <algorithm>
#include <cmath>

#include "drivers/haply_serial/haply_trouble.h"

namespace tactus::drivers {

namespace {

constexpr hal::TimeNs kHaplySettling_ns = 20'000'000;
constexpr hal::TimeNs kHaplyWritePatience_ns = 20'000'000;
// The angles that the first setup tells a board differ from home_rad by at least so many
// tolerances. They differ from each other and from start to start by fractions of one.
constexpr double kHaplyAskedTolerances = 5.0;
constexpr std::uint32_t kHaplyAskedSteps = 11;

HaplyConfig with_possible_axes(HaplyConfig config) {
  config.axes = std::clamp<std::size_t>(config.axes, 1, kHaplyMaxAxes);
  return config;
}

}  // namespace

Haply::Haply(hal::SerialPort& port, const hal::Clock& clock, const HaplyConfig& config)
    : port_(&port),
      clock_(&clock),
      config_(with_possible_axes(config)),
      answers_(config_.axes),
      samples_(config.velocity_cutoff_Hz, config.fastest_rad_per_s) {}

void Haply::start() {
  setup_ = {.starts = setup_.starts + 1};
  samples_.forget();
  reads_ = {};
  faults_.clear();
  if (!config_.unproven_watchdog) {
    latch(kDeviceDriveFault, kHaplyNoWatchdog);
    state_ = State::stopped;
    return;
  }
  set_up();
}

void Haply::forget_answers() {
  answers_.restart();
  last_ = {};
  setup_.at_home_in_a_row = 0;
}

// Returns the angle that the setup tells the axis to count from, rad.
double Haply::told_rad(std::size_t axis) const {
  const double home_rad = config_.axis[axis].home_rad;
  if (setup_.identity == Identity::shown) {
    return home_rad;
  }
  const auto step =
      static_cast<double>((std::size_t{setup_.starts} * 7 + axis * 3) % kHaplyAskedSteps);
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
    samples_.restart_velocity(i);
  }
  const std::uint8_t id = config_.device_id;
  const hal::TimeNs by_ns = clock_->now_ns() + kHaplyWritePatience_ns;
  const Torques none{};
  // A reset leaves the motors' torque as it is, so zero is sent before it.
  (void)(send(haply_torques(id, std::span(none).first(config_.axes)), by_ns) &&
         send(haply_reset(id), by_ns) &&
         send(haply_setup(id, std::span(axes).first(config_.axes)), by_ns));
  setup_.settled_ns = clock_->now_ns() + kHaplySettling_ns;
}

void Haply::clear_faults() {
  if (!faults_ && state_ != State::stopped) {
    return;
  }
  const bool was_set_up = setup_.is_done || setup_.is_reference_lost;
  if ((faults_.status() & kDeviceLost) != 0) {
    (void)port_->reopen();  // if it fails, `start` reports it
  }
  start();
  setup_.is_reference_lost = was_set_up;
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
  reads_.begin();
  if (state_ == State::settling && clock_->now_ns() >= setup_.settled_ns) {
    if (const auto discarded = port_->discard_input(); !discarded) {
      lose(discarded.error());
    }
    state_ = State::running;
  } else if (state_ == State::running) {
    exchange(deadline_ns);
  }
  samples_.report(status(), samples.first(config_.axes));
}

std::uint32_t Haply::status() const {
  if (state_ != State::running || !setup_.is_done) {
    return faults_.status() | kDeviceNotReady |
           (setup_.is_reference_lost ? kDeviceReferenceLost : kDeviceOk);
  }
  return faults_.status() | (reads_.is_fresh() ? kDeviceOk : kDeviceStale);
}

Trouble Haply::trouble(std::size_t /*axis*/) const {
  return faults_.trouble();
}

void Haply::latch(std::uint32_t status, const Trouble& trouble) {
  faults_.latch(status | (setup_.is_done ? kDeviceReferenceLost : kDeviceOk), trouble);
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

void Haply::write(std::span<const AxisCommand> commands) {
  if (state_ != State::running) {
    return;
  }
  const bool allowed = !faults_ && setup_.is_done;
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
  answers_.ask(clock_->now_ns());
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
