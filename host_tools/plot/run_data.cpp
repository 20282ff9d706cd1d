#include "host_tools/plot/run_data.h"

#include <algorithm>

namespace tactus::host {

std::vector<std::size_t> thin(const std::vector<RunRow>& rows, std::size_t limit) {
  std::vector<std::size_t> kept;
  const std::size_t bucket =
      std::max<std::size_t>(1, (2 * rows.size() + limit - 1) / std::max<std::size_t>(1, limit));
  const auto by_force = [](const RunRow& a, const RunRow& b) { return a.force_N < b.force_N; };
  for (std::size_t first = 0; first < rows.size(); first += bucket) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end =
        rows.begin() + static_cast<std::ptrdiff_t>(std::min(first + bucket, rows.size()));
    const auto [smallest, largest] = std::minmax_element(begin, end, by_force);
    const auto [early, late] = std::minmax({smallest - rows.begin(), largest - rows.begin()});
    for (const std::ptrdiff_t index : {std::ptrdiff_t{0}, early, late}) {
      const auto row = static_cast<std::size_t>(index);
      if (kept.empty() || row > kept.back()) {
        kept.push_back(row);
      }
    }
  }
  if (!rows.empty() && kept.back() + 1 != rows.size()) {
    kept.push_back(rows.size() - 1);
  }
  return kept;
}

std::vector<Stretch> stretches(const std::vector<RunRow>& rows, rendering::FrictionState state) {
  std::vector<Stretch> found;
  bool open = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].friction != state) {
      open = false;
      continue;
    }
    const double end_s = i + 1 < rows.size() ? rows[i + 1].t_s : rows[i].t_s;
    if (open) {
      found.back().to_s = end_s;
    } else {
      found.push_back({.from_s = rows[i].t_s, .to_s = end_s});
    }
    open = true;
  }
  return found;
}

}  // namespace tactus::host
