// How late a loop that sleeps to a fixed phase wakes on this machine: Tactus' own loop, and
// cyclictest, which everybody knows, in the same conditions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::host {

inline constexpr std::size_t kJitterBins = 1000;

struct JitterPlan {
  double rate_hz = 1000.0;
  double seconds = 10.0;
  int priority = 80;       // SCHED_FIFO
  std::optional<int> cpu;  // both run there only
};

struct Jitter {
  std::array<std::uint64_t, kJitterBins> bins{};  // bin i: from i up to, not including, i + 1 us
  std::uint64_t overflow = 0;
  std::uint64_t count = 0;
  double min_us = 0.0;
  double mean_us = 0.0;
  double max_us = 0.0;
  // Empty: real-time priority and locked memory were to be had.
  std::string not_real_time;
};

// The upper edge of the bin in which that share (0 to 1) of all wake-ups is reached; the longest
// where that is the overflow.
double percentile_us(const Jitter& jitter, double share);

// Sleeps and wakes as tactusd does, in a thread of its own. Without the right to real-time priority
// it measures all the same, and says so.
Jitter measure_loop(const JitterPlan& plan);

// Runs cyclictest on the same plan; nothing if it is not installed. `real_time` false: at ordinary
// priority, as a fair comparison with a loop that has no other. Throws InputError if it fails.
std::optional<Jitter> measure_cyclictest(const JitterPlan& plan, bool real_time);

// `text` is what `cyclictest --json` wrote. Throws InputError if it is something else.
Jitter read_cyclictest(std::string_view text);

// Bars of a histogram, a line a band of latencies, at most `width` characters a bar; for a
// terminal.
std::string jitter_bars(const Jitter& jitter, std::size_t width);

}  // namespace tactus::host
