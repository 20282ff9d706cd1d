// Counts the durations of ticks, and the bytes of the stack that they used. One thread; real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tactus::firmware {

// The durations of all ticks, counted in classes of equal width; the last one has no upper end.
class TickLoad {
 public:
  static constexpr std::uint32_t kClass_ns = 1000;
  static constexpr std::size_t kClasses = 1024;

  void add(std::uint32_t duration_ns);

  // Returns the longest duration, ns; 0 without a tick.
  [[nodiscard]] std::uint32_t worst_ns() const { return worst_ns_; }

  // Returns the upper end of the class below which 99.9 % of the ticks lie, ns; at most the worst.
  [[nodiscard]] std::uint32_t p999_ns() const;

 private:
  std::array<std::uint32_t, kClasses> counts_{};
  std::uint32_t worst_ns_ = 0;
  std::uint64_t ticks_ = 0;
};

// Returns the bytes of the stack that were ever in use: all above the lowest word without paint.
std::size_t used_bytes(std::span<const std::uint32_t> stack, std::uint32_t paint);

}  // namespace tactus::firmware
