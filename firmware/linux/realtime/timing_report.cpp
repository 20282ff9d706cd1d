#include "firmware/linux/realtime/timing_report.h"

#include <cerrno>
#include <cinttypes>

namespace tactus::firmware {

namespace {

std::uint64_t count_in(const TimeHistogram& histogram, std::size_t bin) {
  return bin < kTimeBins ? histogram.bins()[bin] : histogram.overflow();
}

void write_bin(std::FILE* file, const LoopTiming& timing, std::size_t bin) {
  std::fprintf(file, "%zu", bin);
  for (std::size_t i = 0; i < kTimedNames.size(); ++i) {
    std::fprintf(file, ",%" PRIu64, count_in(timing.of(static_cast<Timed>(i)), bin));
  }
  std::fputc('\n', file);
}

bool has_counts(const LoopTiming& timing, std::size_t bin) {
  for (std::size_t i = 0; i < kTimedNames.size(); ++i) {
    if (count_in(timing.of(static_cast<Timed>(i)), bin) > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

void print_timing(std::FILE* file, const LoopTiming& timing) {
  std::fprintf(file,
               "%" PRIu64 " ticks, %" PRIu64 " missed, %" PRIu64
               " late\n%-10s %9s %9s %9s %9s %9s %9s  us\n",
               timing.of(Timed::tick).count(), timing.missed(), timing.late(), "", "min", "mean",
               "50 %", "99 %", "99.9 %", "max");
  for (std::size_t i = 0; i < kTimedNames.size(); ++i) {
    const TimeHistogram& histogram = timing.of(static_cast<Timed>(i));
    std::fprintf(file, "%-10.*s %9.1f %9.1f %9.0f %9.0f %9.0f %9.1f\n",
                 static_cast<int>(kTimedNames[i].size()), kTimedNames[i].data(),
                 static_cast<double>(histogram.min_ns()) * 1e-3, histogram.mean_ns() * 1e-3,
                 histogram.percentile_us(0.5), histogram.percentile_us(0.99),
                 histogram.percentile_us(0.999), static_cast<double>(histogram.max_ns()) * 1e-3);
  }
}

int write_histogram(const char* path, const LoopTiming& timing) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) {
    return errno;
  }
  std::fputs("time_us", file);
  for (const std::string_view name : kTimedNames) {
    std::fprintf(file, ",%.*s", static_cast<int>(name.size()), name.data());
  }
  std::fputc('\n', file);
  for (std::size_t bin = 0; bin < kTimeBins; ++bin) {
    if (has_counts(timing, bin)) {
      write_bin(file, timing, bin);
    }
  }
  write_bin(file, timing, kTimeBins);
  const bool failed = std::ferror(file) != 0;
  return std::fclose(file) != 0 || failed ? EIO : 0;
}

}  // namespace tactus::firmware
