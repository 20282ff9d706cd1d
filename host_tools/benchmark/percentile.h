// Percentiles of measurements.
#pragma once

#include <cstddef>
#include <span>

namespace tactus::host {

// Returns the value below which the share `part` (0 to 1) of the values lies. `sorted` must be in
// ascending order and not empty.
inline double percentile(std::span<const double> sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

}  // namespace tactus::host
