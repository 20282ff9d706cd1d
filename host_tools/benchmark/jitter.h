// Measures how late a loop wakes on this machine that sleeps to a fixed phase: Tactus' own loop,
// and cyclictest, the usual yardstick, under the same conditions. `tactus bench --loop` prints
// both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::host {

// Bins of 1 us each.
inline constexpr std::size_t kJitterBins = 1000;

// The settings of one measurement.
struct JitterPlan {
  // Wake-ups a second, and how long they are watched.
  double rate_hz = 1000.0;
  double seconds = 10.0;
  // The SCHED_FIFO priority.
  int priority = 80;
  // The processor on which both run; any if not given.
  std::optional<int> cpu;
};

// The latencies of all wake-ups.
struct Jitter {
  // Bin i counts latencies from i us up to but not including i + 1 us.
  std::array<std::uint64_t, kJitterBins> bins{};
  // Latencies beyond the last bin.
  std::uint64_t overflow = 0;
  // The number of all wake-ups, with those of `overflow`.
  std::uint64_t count = 0;
  double min_us = 0.0;
  double mean_us = 0.0;
  double max_us = 0.0;
  // Why real-time priority or locked memory could not be had; empty if they were.
  std::string not_real_time;
};

// Returns the upper edge, us, of the bin in which that share (0 to 1) of all wake-ups is reached,
// or the longest latency if it is reached in the overflow.
double percentile_us(const Jitter& jitter, double share);

// Sleeps and wakes as tactusd does, in a thread of its own. Without the right to real-time priority
// it measures at ordinary priority and says so in `not_real_time`.
Jitter measure_loop(const JitterPlan& plan);

// Runs cyclictest with the same plan; returns nothing if it is not installed. With `real_time`
// false it runs at ordinary priority, for comparison with a loop that has no other. Throws
// InputError if it fails.
std::optional<Jitter> measure_cyclictest(const JitterPlan& plan, bool real_time);

// Reads what `cyclictest --json` wrote. Throws InputError if the text is something else.
Jitter read_cyclictest(std::string_view text);

// Returns a histogram for a terminal, one line a band of latencies, with bars of at most `width`
// characters.
std::string jitter_bars(const Jitter& jitter, std::size_t width);

}  // namespace tactus::host
