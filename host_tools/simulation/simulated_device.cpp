#include "host_tools/simulation/simulated_device.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr int kFewestSubsteps = 10;

// Returns the parameters if they are usable; throws InputError otherwise.
const DeviceParameters& checked(const DeviceParameters& parameters, double tick_s) {
  if (!(tick_s > 0.0) || tick_s > 0.02) {
    throw InputError("the simulation's rate must be at least 50 Hz");
  }
  if (parameters.substeps < kFewestSubsteps) {
    throw InputError("the plant needs at least 10 sub-steps a tick");
  }
  if (!(parameters.plant.moving_mass_kg > 0.0) || !(parameters.encoder_resolution > 0.0) ||
      !(parameters.velocity_cutoff_Hz > 0.0) || !(parameters.effort_limit >= 0.0) ||
      !(parameters.motor_time_constant_s >= 0.0)) {
    throw InputError("the device's mass, encoder and motor parameters must be positive");
  }
  if (parameters.delay_ticks > kMaxCommandDelay) {
    throw InputError(fmt::format("commands may be delayed by at most {} ticks", kMaxCommandDelay));
  }
  if (!rendering::valid(parameters.plant.joint_friction)) {
    throw InputError("the friction of the device's joints must be finite and within its ranges");
  }
  return parameters;  // NOLINT(bugprone-return-const-ref-from-parameter): the caller stores a copy
}

// Returns the whole ticks that cover a time; the small subtraction absorbs rounding.
std::uint64_t ticks_of(double seconds, double tick_s) {
  return static_cast<std::uint64_t>(std::ceil(seconds / tick_s - 1e-9));
}

}  // namespace

SimulatedDevice::SimulatedDevice(const DeviceParameters& parameters, double tick_s, const Vec3& p_B)
    : parameters_(checked(parameters, tick_s)),
      tick_s_(tick_s),
      plant_(parameters.plant),
      joints_{.encoders =
                  {Encoder(parameters.encoder_resolution, parameters.velocity_cutoff_Hz, tick_s),
                   Encoder(parameters.encoder_resolution, parameters.velocity_cutoff_Hz, tick_s),
                   Encoder(parameters.encoder_resolution, parameters.velocity_cutoff_Hz, tick_s)}},
      motors_{Motor(parameters.effort_limit, parameters.motor_time_constant_s,
                    tick_s / parameters.substeps),
              Motor(parameters.effort_limit, parameters.motor_time_constant_s,
                    tick_s / parameters.substeps),
              Motor(parameters.effort_limit, parameters.motor_time_constant_s,
                    tick_s / parameters.substeps)},
      commands_(parameters.delay_ticks),
      ticks_{.ready = ticks_of(parameters.power_up_s, tick_s)} {
  ticks_.homed = ticks_.ready + ticks_of(parameters.homing_s, tick_s);
  plant_.place(p_B);
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    joints_.origin[i] = joint_position(parameters_.plant.mechanism, i, plant_.pose().coordinate[i]);
  }
  sample_encoders();
}

bool SimulatedDevice::active(DeviceFault fault) const {
  const Period& period = faults_.periods[static_cast<std::size_t>(fault)];
  return ticks_.now >= period.first_tick && ticks_.now < period.end_tick;
}

void SimulatedDevice::inject(DeviceFault fault, std::uint32_t ticks) {
  faults_.periods[static_cast<std::size_t>(fault)] = {.first_tick = ticks_.now + 1,
                                                      .end_tick = ticks_.now + 1 + ticks};
}

std::uint32_t SimulatedDevice::status() const {
  std::uint32_t status = faults_.latched_status;
  if (!homed()) {
    status |= ticks_.now < ticks_.ready ? drivers::kDeviceNotReady : drivers::kDeviceHoming;
  }
  if (active(DeviceFault::stale_sample)) {
    status |= drivers::kDeviceStale;
  }
  if (active(DeviceFault::emergency_stop)) {
    status |= drivers::kDeviceEmergencyStop;
  }
  if (active(DeviceFault::lost)) {
    status |= drivers::kDeviceLost;
  }
  return status;
}

void SimulatedDevice::read(drivers::JointSample& sample) const {
  sample = sample_;
  sample.status = status();
}

std::uint32_t SimulatedDevice::write(const drivers::JointCommand& command) {
  if (!active(DeviceFault::lost)) {
    commands_.write(command);
  }
  return status() & (drivers::kDeviceEmergencyStop | drivers::kDeviceLost);
}

void SimulatedDevice::command_motors(const drivers::JointCommand& command) {
  // A drive without power, connection or start-up makes no torque, whatever is commanded.
  constexpr std::uint32_t kPowerOff =
      drivers::kDeviceEmergencyStop | drivers::kDeviceLost | drivers::kDeviceNotReady;
  const bool powered = command.enable && (status() & kPowerOff) == 0;
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    motors_[i].command(powered ? command.effort[i] : 0.0);
  }
}

void SimulatedDevice::advance(const HandParameters& hand, const Vec3& wish_B,
                              const Vec3& next_wish_B) {
  command_motors(commands_.advance());
  const double step_s = tick_s_ / parameters_.substeps;
  const Vec3 wish_step_B = (next_wish_B - wish_B) / parameters_.substeps;
  // The hand moves evenly over the tick; a sub-step wants its wish in the middle of the sub-step.
  Grip grip{.mass_kg = hand.mass_kg,
            .stiffness_N_per_m = hand.stiffness_N_per_m,
            .damping_Ns_per_m = hand.damping_Ns_per_m,
            .wish_p_B = wish_B + 0.5 * wish_step_B,
            .wish_v_B = wish_step_B / step_s};
  for (int step = 0; step < parameters_.substeps; ++step) {
    JointEfforts effort{};
    for (std::size_t i = 0; i < kPlantJoints; ++i) {
      effort[i] = motors_[i].advance();
    }
    plant_.step(effort, grip, step_s);
    grip.wish_p_B += wish_step_B;
  }
  ++ticks_.now;
  sample_encoders();
}

void SimulatedDevice::sample_encoders() {
  // Homing has found the origin: from now on the encoders count from it.
  if (ticks_.now == ticks_.homed) {
    joints_.origin.fill(0.0);
    for (Encoder& encoder : joints_.encoders) {
      encoder.restart();
    }
  }
  const bool frozen = active(DeviceFault::stale_sample) || active(DeviceFault::lost);
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    joints_.encoders[i].sample(
        joint_position(parameters_.plant.mechanism, i, plant_.pose().coordinate[i]) -
        joints_.origin[i]);
    if (!frozen) {
      sample_.position[i] = joints_.encoders[i].position();
      sample_.velocity[i] = joints_.encoders[i].velocity();
    }
  }
  if (active(DeviceFault::encoder_nan)) {
    sample_.position[0] = std::numeric_limits<double>::quiet_NaN();
  }
  sample_.age_us = frozen ? sample_.age_us + static_cast<std::uint32_t>(std::lround(tick_s_ * 1e6))
                          : parameters_.sample_age_us;
  if (active(DeviceFault::emergency_stop)) {
    faults_.latched_status |= drivers::kDeviceEmergencyStop;
  }
}

std::array<double, kPlantJoints> SimulatedDevice::motor_effort() const {
  return {motors_[0].effort(), motors_[1].effort(), motors_[2].effort()};
}

Vec3 SimulatedDevice::motor_force_B() const {
  Vec3 force_B = Vec3::Zero();
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    force_B += motors_[i].effort() * plant_.pose().rows[i];
  }
  return force_B;
}

}  // namespace tactus::host
