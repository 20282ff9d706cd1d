// A whole haptic device in memory, with the hand that holds it, behind the interface that real
// drivers satisfy (drivers::Device). The controller cannot tell it from a real one. Simulation and
// emulators advance it in lockstep with the controller: read, controller, write, advance. A command
// that is written at tick k drives the motors from tick k + delay_ticks on, until another one takes
// over. One thread; no heap after construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "host_tools/simulation/delayed_commands.h"
#include "host_tools/simulation/electronics.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/plant.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// A device's mechanics, electronics and timing.
struct DeviceParameters {
  PlantParameters plant;
  // The size of an encoder's count, rad or m.
  double encoder_resolution = 5e-6;
  // The cut-off of the velocity's low-pass; infinite: the bare difference of two samples.
  double velocity_cutoff_Hz = 100.0;
  // The largest effort of each motor, N m or N.
  double effort_limit = 12.0;
  // The time constant with which a motor follows its command.
  double motor_time_constant_s = 0.5e-3;
  // The delay from a command to the motors, at most kMaxCommandDelay.
  std::size_t delay_ticks = 1;
  // The age of a sample when the controller reads it.
  std::uint32_t sample_age_us = 0;
  // How long the drives take to start; until then the device reports "not ready".
  double power_up_s = 0.01;
  // How long homing takes after that. Until it ends the encoders count from where they woke up, so
  // positions mean nothing.
  double homing_s = 0.2;
  // Sub-steps of the plant a tick, at least 10.
  int substeps = 10;
};

// Faults that a test or a user can inject.
enum class DeviceFault : std::uint8_t {
  // The device repeats its last sample with growing age, and reports kDeviceStale.
  stale_sample,
  // Joint 0 reads NaN, and no status bit says so.
  encoder_nan,
  // The motors lose power; latched until clear_faults().
  emergency_stop,
  // The device repeats its last sample, reports kDeviceLost in read and write, and its motors lose
  // power.
  lost,
};

// A device with its hand. It satisfies drivers::Device.
class SimulatedDevice {
 public:
  // Powers the device up with the handle at rest at `p_B`, m. Throws InputError if a parameter is
  // out of range or `tick_s` is longer than 20 ms.
  SimulatedDevice(const DeviceParameters& parameters, double tick_s, const Vec3& p_B);

  // The next four functions are those of drivers::Device.
  [[nodiscard]] std::size_t joint_count() const { return joints_of(parameters_.plant.mechanism); }
  // Copies the last sample, with the present status.
  void read(drivers::JointSample& sample) const;
  // Takes the command of this tick. Returns kDeviceEmergencyStop and kDeviceLost as they hold.
  std::uint32_t write(const drivers::JointCommand& command);
  // Clears what is latched: the emergency stop.
  void clear_faults() { faults_.latched_status = drivers::kDeviceOk; }

  // Advances the plant by one tick, held by a hand whose wish moves evenly from `wish_B` to
  // `next_wish_B`, m.
  void advance(const HandParameters& hand, const Vec3& wish_B, const Vec3& next_wish_B);

  // Starts a fault that begins with the next tick and lasts `ticks` ticks.
  void inject(DeviceFault fault, std::uint32_t ticks);

  [[nodiscard]] const Plant& plant() const { return plant_; }
  // Returns the effort of each motor now, N m or N.
  [[nodiscard]] std::array<double, kPlantJoints> motor_effort() const;
  // Returns the force of the motors at the handle now, N.
  [[nodiscard]] Vec3 motor_force_B() const;

 private:
  // A span of ticks: from `first_tick` up to but not with `end_tick`.
  struct Period {
    std::uint64_t first_tick = 0;
    std::uint64_t end_tick = 0;
  };

  // The injected faults.
  struct Faults {
    // The newest period of each DeviceFault.
    std::array<Period, 4> periods{};
    // The status bits that stay until clear_faults().
    std::uint32_t latched_status = drivers::kDeviceOk;
  };
  // The ticks since power-up: the present one, the first one with power, the first one after
  // homing.
  struct Ticks {
    std::uint64_t now = 0;
    std::uint64_t ready = 0;
    std::uint64_t homed = 0;
  };
  // The encoders of all joints.
  struct JointEncoders {
    std::array<Encoder, kPlantJoints> encoders;
    // The position at which each encoder woke up; 0 once homing is over.
    std::array<double, kPlantJoints> origin{};
  };

  // Returns true if the fault is injected at this tick.
  [[nodiscard]] bool active(DeviceFault fault) const;
  [[nodiscard]] bool homed() const { return ticks_.now >= ticks_.homed; }
  // Returns the status bits of drivers/device.h that hold now.
  [[nodiscard]] std::uint32_t status() const;
  // Gives the motors their targets; 0 if they are not enabled or have no power.
  void command_motors(const drivers::JointCommand& command);
  // Takes a new sample from the plant, unless a fault keeps the old one.
  void sample_encoders();

  DeviceParameters parameters_;
  double tick_s_;
  Plant plant_;
  JointEncoders joints_;
  std::array<Motor, kPlantJoints> motors_;
  DelayedCommands commands_;
  drivers::JointSample sample_;
  Faults faults_;
  Ticks ticks_;
};

static_assert(drivers::Device<SimulatedDevice>);

}  // namespace tactus::host
