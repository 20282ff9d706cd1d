// Measures how well the loop keeps its time: wake-up latency, duration of the tick and of each of
// its stages, and the numbers of missed and late ticks. The loop's thread adds; read it after the
// loop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/linux/realtime/time_histogram.h"
#include "firmware/telemetry/record.h"
#include "hal/clock.h"

namespace tactus::firmware {

// The times of one tick, ns of CLOCK_MONOTONIC.
struct LoopTick {
  // The time at which it should have begun.
  hal::TimeNs scheduled_ns = 0;
  // The time at which it began.
  hal::TimeNs woke_ns = 0;
  // The time at which the device's write had returned.
  hal::TimeNs done_ns = 0;
  // The number of scheduled ticks missed since the previous tick.
  std::int64_t skipped = 0;
  // True for a late tick: see LoopTiming::woke.
  bool late = false;
};

// The durations that have a histogram. `tick` is from the wake-up to the end of the device's write.
enum class Timed : std::uint8_t { wake_up, tick, read, check, kinematics, touch, safety, write };

// The names of the durations in the order of Timed, for tables.
inline constexpr std::array<std::string_view, 8> kTimedNames = {
    "wake_up", "tick", "read", "check", "kinematics", "touch", "safety", "write"};

// The measurements of one loop, in static memory.
class LoopTiming {
 public:
  // Sets the period of the loop. Call before the first tick.
  void set_period(hal::TimeNs period_ns) { period_ns_ = period_ns; }

  // Begins a tick. The tick is late if it woke more than half a period after its time, or if ticks
  // were skipped before it. Real time.
  LoopTick woke(const hal::Wake& wake);
  // Ends the tick at `now_ns` and adds its durations to the histograms. Real time.
  void done(LoopTick& tick, const StageTimes& stages, hal::TimeNs now_ns);

  // Returns the histogram of a duration.
  [[nodiscard]] const TimeHistogram& of(Timed what) const {
    return histograms_[static_cast<std::size_t>(what)];
  }
  // Returns the number of scheduled ticks that were not run.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }
  // Returns the number of late ticks.
  [[nodiscard]] std::uint64_t late() const { return late_; }

 private:
  TimeHistogram& histogram(Timed what) { return histograms_[static_cast<std::size_t>(what)]; }

  hal::TimeNs period_ns_ = 1'000'000;
  std::array<TimeHistogram, kTimedNames.size()> histograms_;
  std::uint64_t missed_ = 0;
  std::uint64_t late_ = 0;
};

}  // namespace tactus::firmware
