// One tick out of the file that `--explain` writes (host_tools/explain/README.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// A contact plane of a move.
struct StepPlane {
  Vec3 surface_W = Vec3::Zero();
  Vec3 normal_W = Vec3::Zero();
  double multiplier_m = 0.0;
  // `active`, `not reached` or `redundant`.
  std::string fate;
};

// A straight move of the shared proxy, or an iteration on a formula, which has no planes but its
// tangent plane and no circles.
struct StepMove {
  Vec3 from_W = Vec3::Zero();
  Vec3 goal_W = Vec3::Zero();
  Vec3 to_W = Vec3::Zero();
  std::string ending;
  std::vector<StepPlane> planes;
  // The friction circles, m; nothing without contact.
  std::optional<double> static_radius_m;
  std::optional<double> dynamic_radius_m;
};

// The steps of a tick; world frame, m.
struct TickSteps {
  std::size_t number = 0;
  double t_s = 0.0;
  Vec3 tool_W = Vec3::Zero();
  Vec3 from_W = Vec3::Zero();
  Vec3 proxy_W = Vec3::Zero();
  // The point of the surface under the proxy, and the contact normal; nothing without contact.
  std::optional<Vec3> surface_W;
  std::optional<Vec3> normal_W;
  double depth_m = 0.0;
  // 0 free, 1 stick, 2 slip: before and after.
  int friction_before = 0;
  int friction = 0;
  std::vector<StepMove> moves;
};

// The tick to read: the one with that number, or the first that is not before that time, or without
// either the one with most moves.
struct TickChoice {
  std::optional<std::size_t> number;
  std::optional<double> t_s;
};

// Reads one tick. Throws InputError, one line that names file, line and column, and if there is no
// such tick the range of those that there are.
TickSteps read_tick_steps(const std::filesystem::path& file, const TickChoice& choice);

}  // namespace tactus::host
