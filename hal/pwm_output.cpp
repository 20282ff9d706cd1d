#include "hal/pwm_output.h"

namespace tactus::hal {

Result<void> PwmOutput::set_period_ns(TimeNs period_ns) {
  if (period_ns <= 0 || period_ns < settings_.duty_ns) {
    return failure(ErrorCode::invalid_argument);
  }
  const auto done = DoSetPeriod(period_ns);
  if (done) {
    settings_.period_ns = period_ns;
  }
  return done;
}

Result<void> PwmOutput::set_duty_ns(TimeNs duty_ns) {
  if (duty_ns < 0 || duty_ns > settings_.period_ns) {
    return failure(ErrorCode::invalid_argument);
  }
  const auto done = DoSetDuty(duty_ns);
  if (done) {
    settings_.duty_ns = duty_ns;
  }
  return done;
}

Result<void> PwmOutput::set_enabled(bool enabled) {
  if (enabled && settings_.period_ns == 0) {
    return failure(ErrorCode::invalid_state);
  }
  const auto done = DoSetEnabled(enabled);
  if (done) {
    settings_.enabled = enabled;
  }
  return done;
}

}  // namespace tactus::hal
