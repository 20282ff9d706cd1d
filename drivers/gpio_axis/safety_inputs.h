// What the board's safety lines say, latched. Protocol only: no input or output.
#pragma once

#include <algorithm>

#include "hal/clock.h"

namespace tactus::drivers {

struct SafetyLevels {
  bool emergency_stop = false;
  bool fault = false;
  bool limit_low = false;
  bool limit_high = false;
};

// The emergency stop acts at its first edge, however short; it is over when the chain has stood
// closed for the release time. A fault of the bridge acts the same and is over with its level. Both
// stay latched until a reset.
class SafetyInputs {
 public:
  explicit SafetyInputs(hal::TimeNs release_ns) : release_ns_(release_ns) {}

  // Forgets everything; what is active latches again with the next levels.
  void restart() { *this = SafetyInputs(release_ns_); }

  // An edge that made it active.
  void emergency_stop_edge(hal::TimeNs now_ns) { open_chain(now_ns); }
  void fault_edge() { fault_ = true; }

  void take(const SafetyLevels& levels, hal::TimeNs now_ns) {
    limits_ = levels;
    if (levels.emergency_stop) {
      open_chain(now_ns);
    }
    fault_ = fault_ || levels.fault;
  }

  // For a reset. Keeps what is still active, and an emergency stop until the release time is over.
  void clear(hal::TimeNs now_ns) {
    emergency_stop_ = limits_.emergency_stop || now_ns - opened_ns_ < release_ns_;
    fault_ = limits_.fault;
  }

  [[nodiscard]] bool emergency_stop() const { return emergency_stop_; }
  [[nodiscard]] bool fault() const { return fault_; }
  // Both switches: a wire is broken, or the end stop is.
  [[nodiscard]] bool limits_contradict() const { return limits_.limit_low && limits_.limit_high; }

  // The torque without what would push further into an open limit switch.
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
