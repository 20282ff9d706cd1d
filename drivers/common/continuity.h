// The facts about a drive that hold only until it restarts. They survive a reset of its faults.
#pragma once

namespace tactus::drivers {

struct Continuity {
  // The position has been followed without a gap since the drive was first ready. A joint that was
  // homed in this time has its reference.
  bool is_followed = false;
  // The drive's watchdog was seen to stop the motor.
  bool is_proven = false;
};

}  // namespace tactus::drivers
