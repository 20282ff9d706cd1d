// The sample of an axis, made from the reports of its drive.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "drivers/cia402_can/cia402_config.h"
#include "drivers/common/counted_shaft.h"
#include "hal/clock.h"

namespace tactus::drivers::cia402 {

class DriveSample {
 public:
  explicit DriveSample(const Cia402Config& config);

  // Forgets the sample, and accepts the next position whatever it is.
  void forget();
  // Accepts the next position if the shaft can have turned so far while the drive was set up.
  void resume() { shaft_.resume(); }
  // Forgets the torque, for a drive that is brought up.
  void forget_torque() { sample_.has_torque = false; }
  // Makes the torque zero, for a drive in a fault.
  void drop_torque() { sample_.torque_Nm = 0.0; }
  // `status` has DeviceStatus bits.
  void set_status(std::uint32_t status) { sample_.status = status; }

  // Takes a position, in counts, from that time. Returns false, and changes nothing, if the shaft
  // cannot have reached it. The sample does not have it before `show`.
  bool take_position(std::int32_t count, hal::TimeNs time_ns) {
    return shaft_.take(count, time_ns);
  }
  // Puts the position that was taken last into the sample, with the torque, N m, of that time. The
  // velocity is that of the positions, unless the drive reports one.
  void show(double torque_Nm, hal::TimeNs time_ns);
  // Takes a velocity, in the drive's unit. Returns false, and changes nothing, if it is beyond
  // max_speed_rad_per_s. A velocity is ignored if the configuration has no unit for it.
  bool take_velocity(std::int32_t velocity);

  [[nodiscard]] const AxisSample& sample() const { return sample_; }

 private:
  CountedShaft shaft_;
  AxisSample sample_;
  // The unit of the velocities that the drive reports; 0: it reports none.
  double velocity_unit_rad_per_s_;
  double max_speed_rad_per_s_;
};

}  // namespace tactus::drivers::cia402
