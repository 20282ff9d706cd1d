// The positions of a tool from a CSV file. `tactus touch` and `tactus compare` follow them tick by
// tick.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::host {

// The tool at each tick, world frame. The velocity is the difference to the tick before.
class ToolPath {
 public:
  // Reads the columns t_s, x_m, y_m and z_m; one row is one tick. Throws InputError that names
  // file, line and column.
  explicit ToolPath(const std::string& file);
  // Takes over positions at times that grow; there are as many of both, at least one. `name` stands
  // for the file in messages.
  ToolPath(std::string name, std::vector<double> times_s, std::vector<Vec3> positions_W)
      : file_(std::move(name)),
        times_s_(std::move(times_s)),
        positions_W_(std::move(positions_W)) {}

  // Returns this path at `rate_Hz`: straight from row to row, from the first time to the last.
  // Throws InputError if that is more than ten million ticks.
  [[nodiscard]] ToolPath sampled(double rate_Hz) const;

  // Returns a warning that names the first row where the tool is farther from the world's origin
  // than hands reach; nothing if there is none.
  [[nodiscard]] std::optional<std::string> warning() const;

  [[nodiscard]] std::size_t size() const { return times_s_.size(); }
  // Returns the time of a tick, s.
  [[nodiscard]] double time_s(std::size_t tick) const { return times_s_[tick]; }
  // Returns the time since the tick before, s; of the first one that to the second, or 1 ms.
  [[nodiscard]] double step_s(std::size_t tick) const;
  // Returns the tool at a tick, m and m/s; at rest in the first. After the last tick it rests where
  // the path ends.
  [[nodiscard]] rendering::ToolState tool(std::size_t tick) const;
  // Returns where a tick stands, for messages: file:line, or the file alone of a sampled path.
  [[nodiscard]] std::string place(std::size_t tick) const;

 private:
  ToolPath() = default;

  // The file and, for messages, the line of each tick's row; empty without a file.
  std::string file_;
  std::vector<std::size_t> lines_;
  std::vector<double> times_s_;
  std::vector<Vec3> positions_W_;
};

}  // namespace tactus::host
