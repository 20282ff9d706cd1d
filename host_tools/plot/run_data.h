// The columns of a run that the figures need, whether the simulation (`tactus sim`) or a replay
// (`tactus touch`) wrote it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::host {

struct RunRow {
  double t_s = 0.0;
  Vec3 proxy_W = Vec3::Zero();  // m
  Vec3 force_W = Vec3::Zero();  // N, the rendered force
  double force_N = 0.0;         // its magnitude
  double commanded_N =
      0.0;  // of the force after the limits; equal to force_N where the run has none
  double depth_m = 0.0;
  bool contact = false;
  bool located = true;  // false while the controller does not know where the tool is
  rendering::FrictionState friction = rendering::FrictionState::free;
};

struct RunData {
  std::vector<RunRow> rows;  // at least one, times rising
  bool has_commanded = false;
};

// Throws InputError, one line that names file, line and column.
RunData read_run(const std::filesystem::path& file);

// Indices of at most about `limit` rows that look like all of them: the first and the last, and of
// every bucket the rows with the smallest and the largest force. Rising.
std::vector<std::size_t> thin(const std::vector<RunRow>& rows, std::size_t limit);

// A stretch of rows of one kind.
struct Stretch {
  double from_s = 0.0;
  double to_s = 0.0;
};

// Returns the stretches of time in which friction was in that state. A stretch ends at the time of
// the row after it.
std::vector<Stretch> stretches(const std::vector<RunRow>& rows, rendering::FrictionState state);

}  // namespace tactus::host
