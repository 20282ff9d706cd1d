// How long ticks take, and how much of the stack they need. One thread; real time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tactus::firmware {

// The durations of all ticks, counted in classes of equal width.
class TickLoad {
 public:
  static constexpr std::uint32_t kClass_ns = 1000;

  void add(std::uint32_t duration_ns) {
    worst_ns_ = std::max(worst_ns_, duration_ns);
    ++counts_[std::min<std::size_t>(duration_ns / kClass_ns, counts_.size() - 1)];
    ++ticks_;
  }

  [[nodiscard]] std::uint32_t worst_ns() const { return worst_ns_; }

  // Returns the upper end of the class below which 99.9 % of the ticks lie, ns; at most the worst.
  [[nodiscard]] std::uint32_t p999_ns() const {
    std::uint64_t above = 0;
    for (std::size_t i = counts_.size(); i-- > 0;) {
      above += counts_[i];
      if (above * 1000 > ticks_) {
        return std::min(worst_ns_, static_cast<std::uint32_t>(i + 1) * kClass_ns);
      }
    }
    return worst_ns_;
  }

 private:
  std::array<std::uint32_t, 1024> counts_{};
  std::uint32_t worst_ns_ = 0;
  std::uint64_t ticks_ = 0;
};

// Returns the bytes of the stack that were ever in use: all above the lowest word without paint.
inline std::size_t used_bytes(std::span<const std::uint32_t> stack, std::uint32_t paint) {
  const auto first = std::ranges::find_if(stack, [&](std::uint32_t word) { return word != paint; });
  return static_cast<std::size_t>(stack.end() - first) * sizeof(std::uint32_t);
}

}  // namespace tactus::firmware
