// The paths of several tools on one clock. `tactus touch` steps the world once a row of them.
#pragma once

#include <cstddef>
#include <vector>

#include "host_tools/touch/tool_path.h"
#include "rendering/touch.h"

namespace tactus::host {

// The longest path is the clock. A path that ends earlier leaves its tool where it is.
class ToolPaths {
 public:
  // Takes one path for each tool. Throws InputError if there are no paths or more than kMaxTools,
  // and InputError that names both files and their times if the same row of two paths is not at the
  // same time.
  explicit ToolPaths(std::vector<ToolPath> paths);

  [[nodiscard]] std::size_t tools() const { return paths_.size(); }
  // Returns the number of ticks.
  [[nodiscard]] std::size_t size() const { return paths_[longest_].size(); }
  // Returns the time of a tick, s.
  [[nodiscard]] double time_s(std::size_t tick) const { return paths_[longest_].time_s(tick); }
  // Returns the time since the tick before, s; of the first one that to the second, or 1 ms.
  [[nodiscard]] double step_s(std::size_t tick) const { return paths_[longest_].step_s(tick); }
  // Returns a tool at a tick, m and m/s, world frame.
  [[nodiscard]] rendering::ToolState tool(std::size_t number, std::size_t tick) const {
    return paths_[number].tool(tick);
  }

 private:
  // Throws InputError if a row of the path is at another time than that row of the longest one.
  void check_times(const ToolPath& path) const;

  std::vector<ToolPath> paths_;
  // The number of the longest path, the first if there are several.
  std::size_t longest_ = 0;
};

}  // namespace tactus::host
