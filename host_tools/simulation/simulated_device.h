// A whole haptic device in memory, hand included, behind the seam that the real drivers satisfy
// (drivers::Device).
//
// One tick of lockstep: read, controller, write, advance. A command written at tick k drives the
// motors from tick k + delay_ticks on, for as long as no other is written. One thread; no heap
// after construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "host_tools/simulation/electronics.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/plant.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

inline constexpr std::size_t kMaxCommandDelay = 8;

struct DeviceParameters {
  PlantParameters plant;
  double encoder_resolution = 5e-6;   // rad or m a count
  double velocity_cutoff_Hz = 100.0;  // infinite: the bare difference of two samples
  double effort_limit = 12.0;         // N m or N a joint
  double motor_time_constant_s = 0.5e-3;
  std::size_t delay_ticks = 1;      // from a command to the motors, at most kMaxCommandDelay
  std::uint32_t sample_age_us = 0;  // from the encoder's reading to `read`
  double power_up_s = 0.01;         // not ready: the drives start
  double homing_s = 0.2;  // then homing: until its end encoders count from where they woke up
  int substeps = 10;      // of the plant a tick, >= 10
};

// The faults that can be injected.
enum class DeviceFault : std::uint8_t {
  stale_sample,    // the last sample again, growing old, kDeviceStale
  encoder_nan,     // joint 0 reads NaN, and no status bit says so
  emergency_stop,  // motors without power; latched until cleared
  lost,            // the last sample, kDeviceLost in read and write, motors without power
};

class SimulatedDevice {
 public:
  // The device is powered up with the handle at rest at p_B. Throws InputError, text for a user, on
  // parameters out of range.
  SimulatedDevice(const DeviceParameters& parameters, double tick_s, const Vec3& p_B);

  // drivers::Device
  [[nodiscard]] std::size_t joint_count() const { return joints_of(parameters_.plant.mechanism); }
  void read(drivers::JointSample& sample) const;
  std::uint32_t write(const drivers::JointCommand& command);
  void clear_faults() { latched_status_ = drivers::kDeviceOk; }

  // Advances the plant by one tick, held by a hand whose wish moves evenly between the two points.
  void advance(const HandParameters& hand, const Vec3& wish_B, const Vec3& next_wish_B);

  // Injects a fault that begins with the next tick and lasts `ticks` ticks.
  void inject(DeviceFault fault, std::uint32_t ticks);

  [[nodiscard]] const Plant& plant() const { return plant_; }
  [[nodiscard]] std::array<double, kPlantJoints> motor_effort() const;
  // Returns the force of the motors at the handle now, N.
  [[nodiscard]] Vec3 motor_force_B() const;

 private:
  struct Period {
    std::uint64_t first_tick = 0;
    std::uint64_t end_tick = 0;
  };

  [[nodiscard]] bool active(DeviceFault fault) const;
  [[nodiscard]] bool homed() const { return ticks_ >= homed_tick_; }
  [[nodiscard]] std::uint32_t status() const;
  void command_motors(const drivers::JointCommand& command);
  void sample_encoders();

  DeviceParameters parameters_;
  double tick_s_;
  Plant plant_;
  std::array<Encoder, kPlantJoints> encoders_;
  std::array<Motor, kPlantJoints> motors_;
  std::array<double, kPlantJoints> encoder_origin_{};
  drivers::JointCommand written_;
  std::array<drivers::JointCommand, kMaxCommandDelay + 1> in_flight_{};  // by tick, in a ring
  drivers::JointSample sample_;
  std::array<Period, 4> fault_periods_{};  // by DeviceFault
  std::uint64_t ticks_ = 0;
  std::uint64_t ready_tick_ = 0;
  std::uint64_t homed_tick_ = 0;
  std::uint32_t latched_status_ = drivers::kDeviceOk;
};

static_assert(drivers::Device<SimulatedDevice>);

}  // namespace tactus::host
