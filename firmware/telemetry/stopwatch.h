// Measures the stages of a tick with the caller's clock. One thread; real time if the clock is.
#pragma once

#include <cstdint>
#include <limits>

namespace tactus::firmware {

// A function that returns a monotonic time in ns and may be called from the tick; null: no clock.
using NowNs = std::uint64_t (*)();

// A watch that starts with its construction.
class Stopwatch {
 public:
  explicit Stopwatch(NowNs now_ns) : now_ns_(now_ns), last_ns_(now_ns != nullptr ? now_ns() : 0) {}

  // Returns the ns since construction or the previous lap, at most 4.29 s; 0 without a clock.
  std::uint32_t lap_ns() {
    if (now_ns_ == nullptr) {
      return 0;
    }
    const std::uint64_t now = now_ns_();
    const std::uint64_t elapsed = now - last_ns_;
    last_ns_ = now;
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(elapsed < kMost ? elapsed : kMost);
  }

 private:
  NowNs now_ns_;
  std::uint64_t last_ns_;
};

}  // namespace tactus::firmware
