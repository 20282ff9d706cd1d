#include "firmware/bare_metal/tick_load.h"

#include <algorithm>

namespace tactus::firmware {

void TickLoad::add(std::uint32_t duration_ns) {
  worst_ns_ = std::max(worst_ns_, duration_ns);
  ++counts_[std::min<std::size_t>(duration_ns / kClass_ns, kClasses - 1)];
  ++ticks_;
}

std::uint32_t TickLoad::p999_ns() const {
  std::uint64_t above = 0;
  for (std::size_t i = kClasses; i-- > 0;) {
    above += counts_[i];
    if (above * 1000 > ticks_) {
      const bool has_end = i + 1 < kClasses;
      return has_end ? std::min(worst_ns_, static_cast<std::uint32_t>(i + 1) * kClass_ns)
                     : worst_ns_;
    }
  }
  return worst_ns_;
}

std::size_t used_bytes(std::span<const std::uint32_t> stack, std::uint32_t paint) {
  const auto first = std::ranges::find_if(stack, [&](std::uint32_t word) { return word != paint; });
  return static_cast<std::size_t>(stack.end() - first) * sizeof(std::uint32_t);
}

}  // namespace tactus::firmware
