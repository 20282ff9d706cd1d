#include "host_tools/touch/tool_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_tools/input_error.h"
#include "rendering/limits.h"

namespace tactus::host {

ToolPaths::ToolPaths(std::vector<ToolPath> paths) : paths_(std::move(paths)) {
  if (paths_.empty() || paths_.size() > rendering::kMaxTools) {
    throw InputError(fmt::format("--path: {} paths; a world has 1 to {} tools, each with a path",
                                 paths_.size(), rendering::kMaxTools));
  }
  const auto longest = std::ranges::max_element(paths_, {}, &ToolPath::size);
  longest_ = static_cast<std::size_t>(longest - paths_.begin());
  for (const ToolPath& path : paths_) {
    check_times(path);
  }
}

void ToolPaths::check_times(const ToolPath& path) const {
  // Files round their times: to a microsecond that is a hundredth of a tick at 10 kHz.
  constexpr double kRounding = 0.01;
  const ToolPath& clock = paths_[longest_];
  for (std::size_t row = 0; row < path.size(); ++row) {
    if (std::abs(path.time_s(row) - clock.time_s(row)) <= kRounding * clock.step_s(row)) {
      continue;
    }
    if (row == 0) {
      throw InputError(fmt::format(
          "{}: the path begins at {:.9g} s, but {} at {:.9g} s; let all paths begin at one time",
          path.place(row), path.time_s(row), clock.place(row), clock.time_s(row)));
    }
    throw InputError(fmt::format(
        "{}: {:.9g} s, which is {:.6g} s after the row before, but {}: {:.9g} s, which is {:.6g} s "
        "after the row before; all tools share the ticks, so give --rate or equal times",
        path.place(row), path.time_s(row), path.step_s(row), clock.place(row), clock.time_s(row),
        clock.step_s(row)));
  }
}

}  // namespace tactus::host
