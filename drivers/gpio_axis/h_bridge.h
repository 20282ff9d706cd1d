// Converts a torque to a duty and a direction. It has no input or output.
#pragma once

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "hal/clock.h"

namespace tactus::drivers {

// Returns the duty for a share of the full torque, both from 0 to 1.
double duty_of(TorqueLaw law, double torque_part);

// The outputs to the bridge: the time of a period for which the PWM is on, and the direction.
struct BridgeOutput {
  hal::TimeNs duty_ns = 0;
  bool reverse = false;  // the direction line; false for locked anti-phase
};

// Drives an H-bridge. The duty never exceeds max_duty or stands for more than max_torque_Nm. A
// torque of NaN counts as zero. Sign-magnitude keeps the direction line still until the duty has
// been zero for the dead time.
class HBridge {
 public:
  explicit HBridge(const BridgeConfig& config);

  BridgeOutput drive(double torque_Nm, hal::TimeNs now_ns);
  // Returns the output for zero torque, which acts at once.
  BridgeOutput idle(hal::TimeNs now_ns) { return drive(0.0, now_ns); }

 private:
  BridgeOutput sign_magnitude(double part, bool negative, hal::TimeNs now_ns);
  [[nodiscard]] BridgeOutput locked_antiphase(double part, bool negative) const;

  BridgeConfig config_;
  bool reverse_ = false;
  bool driving_ = false;
  hal::TimeNs idle_since_ns_ = 0;
};

}  // namespace tactus::drivers
