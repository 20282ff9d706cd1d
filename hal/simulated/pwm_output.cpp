#include "hal/simulated/pwm_output.h"

#include <algorithm>

namespace tactus::hal {

std::span<const SimulatedPwmWrite> SimulatedPwmOutput::writes() const {
  const std::size_t recorded = std::min(write_count_, kRecorded);
  return std::span(writes_).first(recorded);
}

double SimulatedPwmOutput::mean_level() const {
  const PwmSettings& now = settings();
  if (!now.enabled) {
    return 0.0;
  }
  return static_cast<double>(now.duty_ns) / static_cast<double>(now.period_ns);
}

void SimulatedPwmOutput::fail_next(std::uint32_t count, ErrorCode code) {
  failing_ = count;
  failure_code_ = code;
}

Result<void> SimulatedPwmOutput::record(const PwmSettings& settings) {
  if (failing_ > 0) {
    --failing_;
    return failure(failure_code_);
  }
  if (write_count_ < kRecorded) {
    writes_[write_count_] = {.time_ns = clock_.now_ns(), .settings = settings};
  }
  ++write_count_;
  return {};
}

Result<void> SimulatedPwmOutput::DoSetPeriod(TimeNs period_ns) {
  PwmSettings next = settings();
  next.period_ns = period_ns;
  return record(next);
}

Result<void> SimulatedPwmOutput::DoSetDuty(TimeNs duty_ns) {
  PwmSettings next = settings();
  next.duty_ns = duty_ns;
  return record(next);
}

Result<void> SimulatedPwmOutput::DoSetEnabled(bool enabled) {
  PwmSettings next = settings();
  next.enabled = enabled;
  return record(next);
}

}  // namespace tactus::hal
