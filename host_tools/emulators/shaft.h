// The motor shaft between an emulated drive and the plant that turns it.
#pragma once

namespace tactus::host {

// The plant writes position and velocity before an emulator runs, and the emulator leaves the
// torque that its motor exerts. All three are at the motor's shaft.
struct EmulatedShaft {
  double position_rad = 0.0;
  double velocity_rad_per_s = 0.0;
  double torque_Nm = 0.0;
};

}  // namespace tactus::host
