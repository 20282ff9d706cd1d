// A PWM channel in memory. One thread; see simulated/clock.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/pwm_output.h"

namespace tactus::hal {

// One recorded write of a setting.
struct SimulatedPwmWrite {
  TimeNs time_ns = 0;
  PwmSettings settings;  // the settings after the write
};

// A channel whose writes a test can read back.
//
// Simulated: a channel that records each write with its time, and that can fail. Not simulated: the
// waveform, the rounding to a hardware clock, the duration of a write.
class SimulatedPwmOutput final : public PwmOutput {
 public:
  // The number of writes that are kept.
  static constexpr std::size_t kRecorded = 256;

  // The clock gives the times of the writes and must outlive this.
  explicit SimulatedPwmOutput(const Clock& clock) : clock_(clock) {}

  // Returns the writes since opening, at most the first kRecorded. `write_count` counts all.
  std::span<const SimulatedPwmWrite> writes() const;
  std::size_t write_count() const { return write_count_; }

  // Returns the average level of the pin, 0 to 1: duty / period, 0 if disabled.
  double mean_level() const;

  // Makes the next `count` writes fail with `code` and change nothing.
  void fail_next(std::uint32_t count, ErrorCode code);

 private:
  Result<void> DoSetPeriod(TimeNs period_ns) override;
  Result<void> DoSetDuty(TimeNs duty_ns) override;
  Result<void> DoSetEnabled(bool enabled) override;
  // Records the settings, or fails as fail_next() says.
  Result<void> record(const PwmSettings& settings);

  const Clock& clock_;
  std::array<SimulatedPwmWrite, kRecorded> writes_{};
  std::size_t write_count_ = 0;
  std::uint32_t failing_ = 0;
  ErrorCode failure_code_ = ErrorCode::io;
};

}  // namespace tactus::hal
