// The states of the board's safety lines, latched. It has no input or output.
#pragma once

#include <algorithm>

#include "hal/clock.h"

namespace tactus::drivers {

// True means that the condition holds now.
struct SafetyLevels {
  bool emergency_stop = false;
  bool fault = false;
  bool limit_low = false;
  bool limit_high = false;
};

// The emergency stop acts at its first edge, however short. It ends when the chain has been closed
// for the release time. A fault of the bridge acts at its first edge too, and ends with its level.
// Both stay latched until a reset.
class SafetyInputs {
 public:
  explicit SafetyInputs(hal::TimeNs release_ns) : release_ns_(release_ns) {}

  // Forgets everything. Active lines latch again with the next levels.
  void restart() { *this = SafetyInputs(release_ns_); }

  // These take an edge that made the line active.
  void emergency_stop_edge(hal::TimeNs now_ns) { open_chain(now_ns); }
  void fault_edge() { fault_ = true; }

  void take(const SafetyLevels& levels, hal::TimeNs now_ns) {
    limits_ = levels;
    if (levels.emergency_stop) {
      open_chain(now_ns);
    }
    fault_ = fault_ || levels.fault;
  }

  // Clears the latches at a reset, except active lines and an emergency stop within its release
  // time.
  void clear(hal::TimeNs now_ns);

  [[nodiscard]] bool emergency_stop() const { return emergency_stop_; }
  [[nodiscard]] bool fault() const { return fault_; }
  // Returns true if both limit switches are active: a wire or an end stop is broken.
  [[nodiscard]] bool limits_contradict() const { return limits_.limit_low && limits_.limit_high; }

  // Returns the torque without the part that pushes further into an active limit switch, N m.
  [[nodiscard]] double within_limits(double torque_Nm) const {
    const double low = limits_.limit_low ? std::max(torque_Nm, 0.0) : torque_Nm;
    return limits_.limit_high ? std::min(low, 0.0) : low;
  }

 private:
  void open_chain(hal::TimeNs now_ns) {
    emergency_stop_ = true;
    opened_ns_ = now_ns;
  }

  hal::TimeNs release_ns_;
  SafetyLevels limits_;
  hal::TimeNs opened_ns_ = 0;  // when the chain was last seen open
  bool emergency_stop_ = false;
  bool fault_ = false;
};

}  // namespace tactus::drivers
