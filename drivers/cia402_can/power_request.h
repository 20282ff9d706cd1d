// The request for motor power, and the drive's answer to it.
#pragma once

#include "drivers/common/seconds.h"
#include "hal/clock.h"

namespace tactus::drivers::cia402 {

class PowerRequest {
 public:
  // Wants power from that time on. A request that is open already stays as it is.
  void open(hal::TimeNs now_ns) {
    if (!is_open_) {
      *this = PowerRequest{};
      is_open_ = true;
      opened_ns_ = now_ns;
    }
  }
  void close() { *this = PowerRequest{}; }

  // Notes that the drive has power at that time.
  void note_power(hal::TimeNs now_ns) {
    is_granted_ = is_granted_ || has_passed(kPowerSettles_s, opened_ns_, now_ns);
  }
  // Notes that the drive has power and the motor its supply.
  void note_supply() { had_supply_ = is_open_; }

  // Returns true once the drive has had power for long enough to be sure. From then on a state
  // without power is a fault.
  [[nodiscard]] bool is_granted() const { return is_granted_; }
  // Returns true if the motor has had its supply since the request was opened.
  [[nodiscard]] bool had_supply() const { return had_supply_; }
  [[nodiscard]] bool is_older_than(double time_s, hal::TimeNs now_ns) const {
    return has_passed(time_s, opened_ns_, now_ns);
  }

 private:
  // For this time a state without power is no fault, since the drive may not have taken the last
  // controlword yet.
  static constexpr double kPowerSettles_s = 0.01;

  hal::TimeNs opened_ns_ = 0;
  bool is_open_ = false;
  bool is_granted_ = false;
  bool had_supply_ = false;
};

}  // namespace tactus::drivers::cia402
