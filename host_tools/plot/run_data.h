// The columns of a run that the figures need, whether it is a recording or a table that `tactus
// sim`, `tactus touch`, tactusd or `tactus export` wrote.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::host {

// One tick.
struct RunRow {
  double t_s = 0.0;
  // The proxy's centre, m, world frame.
  Vec3 proxy_W = Vec3::Zero();
  // The rendered force, N, world frame.
  Vec3 force_W = Vec3::Zero();
  // Its magnitude.
  double force_N = 0.0;
  // The magnitude of the force after the safety limits, N; equal to `force_N` if the run has no
  // such column.
  double commanded_N = 0.0;
  // How far the tool is below the surface.
  double depth_m = 0.0;
  bool contact = false;
  // False while the controller does not know where the tool is.
  bool located = true;
  // The friction state: the proxy sticks or slides.
  rendering::FrictionState friction = rendering::FrictionState::free;
};

// A run, with at least one row and rising times.
struct RunData {
  std::vector<RunRow> rows;
  // True if the file has the force after the safety limits.
  bool has_commanded = false;
  // True if the recording was cut off by a crash: its last ticks are missing.
  bool is_cut = false;
};

// Returns true if the file's name is that of a recording (.mcap).
bool is_recording(const std::filesystem::path& file);

// Reads a run: a recording by its extension, a table otherwise. Throws InputError, one line that
// names the file, and line and column of a table.
RunData read_run(const std::filesystem::path& file);

// Returns the rising indices of at most about `limit` rows that look like all of them: the first
// and the last, and of every bucket the rows with the smallest and the largest force, so that every
// peak is kept.
std::vector<std::size_t> thin(const std::vector<RunRow>& rows, std::size_t limit);

// A span of time.
struct Stretch {
  double from_s = 0.0;
  double to_s = 0.0;
};

// Returns the stretches of time in which friction was in that state. A stretch ends at the time of
// the row after it.
std::vector<Stretch> stretches(const std::vector<RunRow>& rows, rendering::FrictionState state);

}  // namespace tactus::host
