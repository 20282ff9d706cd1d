// The motor shaft between an emulated drive and the plant that it turns.
#pragma once

namespace tactus::host {

// The plant writes position and velocity before an emulator runs, the emulator leaves the torque
// that its motor exerts. Motor shaft: rad, rad/s, N m.
struct EmulatedShaft {
  double position_rad = 0.0;
  double velocity_rad_per_s = 0.0;
  double torque_Nm = 0.0;
};

}  // namespace tactus::host
