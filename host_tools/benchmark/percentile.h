#pragma once

#include <cstddef>
#include <span>

namespace tactus::host {

// The value below which `part` of them lie; they are in ascending order, and not empty.
inline double percentile(std::span<const double> sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace tactus::host
