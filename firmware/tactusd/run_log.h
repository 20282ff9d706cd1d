// The run's ticks in memory that was taken before the start, written as CSV after the end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/composed_device.h"
#include "firmware/telemetry/record.h"
#include "hal/clock.h"

namespace tactus::firmware {

struct LoggedTick {
  hal::TimeNs scheduled_ns = 0;  // CLOCK_MONOTONIC
  hal::TimeNs woke_ns = 0;
  hal::TimeNs done_ns = 0;
  hal::TimeNs sample_ns = 0;  // of the first joint's encoder
  std::array<double, drivers::kMaxJoints> shaft_rad{};
  std::array<double, drivers::kMaxJoints> torque_Nm{};  // commanded at the motors' shafts
  TelemetryRecord record;
};

class RunLog {
 public:
  RunLog() = default;
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  ~RunLog();

  // Takes and touches the memory; false if there is not so much. Before the start.
  bool reserve(std::size_t ticks);

  // Real time. Ticks beyond the reserve are counted, not kept.
  void add(const LoggedTick& tick);

  // 0, or errno. After the end.
  [[nodiscard]] int write_csv(const char* path, std::size_t joints) const;
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  std::span<LoggedTick> ticks_;
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
};

}  // namespace tactus::firmware
