// A histogram of durations, with bins of one microsecond in static memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::firmware {

// The number of bins. At 1 kHz or faster, a longer duration has missed a tick.
inline constexpr std::size_t kTimeBins = 1000;

// Bin i counts times from i up to, but not including, i + 1 us; longer ones share the overflow.
// Times below zero count as zero. One thread at a time.
class TimeHistogram {
 public:
  // Counts one duration. Real time.
  void add(std::int64_t time_ns);

  // Returns the counts of the bins.
  [[nodiscard]] const std::array<std::uint64_t, kTimeBins>& bins() const { return bins_; }
  // Returns the number of durations beyond the last bin.
  [[nodiscard]] std::uint64_t overflow() const { return overflow_; }
  // Returns the number of all durations.
  [[nodiscard]] std::uint64_t count() const { return count_; }

  // Return the shortest, longest and mean duration; all are 0 while nothing has been counted.
  [[nodiscard]] std::int64_t min_ns() const { return min_ns_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  [[nodiscard]] double mean_ns() const;

  // Returns the upper edge, us, of the bin that contains the given quantile. `share` is from 0
  // to 1. If the quantile is beyond the last bin, returns the longest duration.
  [[nodiscard]] double percentile_us(double share) const;

 private:
  std::array<std::uint64_t, kTimeBins> bins_{};
  std::uint64_t overflow_ = 0;
  std::uint64_t count_ = 0;
  std::int64_t sum_ns_ = 0;
  std::int64_t min_ns_ = 0;
  std::int64_t max_ns_ = 0;
};

}  // namespace tactus::firmware
