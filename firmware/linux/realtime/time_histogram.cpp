#include "firmware/linux/realtime/time_histogram.h"

#include <algorithm>

namespace tactus::firmware {

namespace {

constexpr std::int64_t kBinWidth_ns = 1000;

}  // namespace

void TimeHistogram::add(std::int64_t time_ns) {
  const std::int64_t time = std::max<std::int64_t>(0, time_ns);
  const auto bin = static_cast<std::size_t>(time / kBinWidth_ns);
  if (bin < kTimeBins) {
    ++bins_[bin];
  } else {
    ++overflow_;
  }
  min_ns_ = count_ == 0 ? time : std::min(min_ns_, time);
  max_ns_ = std::max(max_ns_, time);
  sum_ns_ += time;
  ++count_;
}

double TimeHistogram::mean_ns() const {
  return count_ == 0 ? 0.0 : static_cast<double>(sum_ns_) / static_cast<double>(count_);
}

double TimeHistogram::percentile_us(double share) const {
  if (count_ == 0) {
    return 0.0;
  }
  const double wanted = share * static_cast<double>(count_);
  std::uint64_t reached = 0;
  for (std::size_t bin = 0; bin < kTimeBins; ++bin) {
    reached += bins_[bin];
    if (static_cast<double>(reached) >= wanted) {
      return static_cast<double>(bin + 1);
    }
  }
  return static_cast<double>(max_ns_) * 1e-3;
}

}  // namespace tactus::firmware
