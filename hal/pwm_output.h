// One PWM channel, for driving an H-bridge: the share of the period in which the output is high is
// the motor's voltage.
#pragma once

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// The output is high for the duty time, then low.
struct PwmSettings {
  // The length of a period; 0 while none was set.
  TimeNs period_ns = 0;
  // The part of each period that is high, or low if inversed; 0 to period_ns.
  TimeNs duty_ns = 0;
  bool enabled = false;
};

// One channel. An implementation opens it disabled, at duty 0. The level of a disabled output
// depends on the board. For a safe zero keep the output enabled at duty 0, and switch the bridge
// off by a separate line.
//
// Real time: set_duty_ns and set_enabled, after opening; they allocate nothing. Thread: one at a
// time for each object; not from an interrupt. Every call can return, besides the errors that it
// lists:
//   disconnected   the chip is gone
//   not_supported  the hardware cannot do this period or duty
//   io             anything else the system reports
// After an error the settings are unchanged.
class PwmOutput {
 public:
  PwmOutput(const PwmOutput&) = delete;
  PwmOutput& operator=(const PwmOutput&) = delete;

  // Sets the period. The hardware may round it to what its clock can divide. To make it shorter
  // than the duty, lower the duty first.
  //   invalid_argument  not above 0, or below the duty
  Result<void> set_period_ns(TimeNs period_ns);

  // Sets the duty time.
  //   invalid_argument  below 0 or above the period
  Result<void> set_duty_ns(TimeNs duty_ns);

  // Enables or disables the output.
  //   invalid_state  enabling before a period was set
  Result<void> set_enabled(bool enabled);

  // Returns the settings as last set, without a system call.
  const PwmSettings& settings() const { return settings_; }

 protected:
  PwmOutput() = default;
  ~PwmOutput() = default;

 private:
  // The public functions have checked the arguments.
  virtual Result<void> DoSetPeriod(TimeNs period_ns) = 0;
  virtual Result<void> DoSetDuty(TimeNs duty_ns) = 0;
  virtual Result<void> DoSetEnabled(bool enabled) = 0;

  PwmSettings settings_;
};

}  // namespace tactus::hal
