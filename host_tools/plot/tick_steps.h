// One tick out of the file that `--explain` writes (host_tools/explain/README.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

// The columns of an iteration on a formula that describe its proxy.
struct FormulaStep {
  // The number of the object in the scene.
  std::size_t object = 0;
  // The unit normal of the tangent plane under the proxy before the move; nothing at a singular
  // point.
  std::optional<Vec3> normal_W;
  // The height of the proxy above the surface to first order, and that below which it is in
  // contact.
  double height_m = 0.0;
  double tolerance_m = 0.0;
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
  // An iteration on a formula has it.
  std::optional<FormulaStep> formula;
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

// Every `step`th tick from one number to another one.
struct TickRange {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t step = 1;

  // Returns the number of ticks.
  [[nodiscard]] std::size_t count() const { return (last - first) / step + 1; }
};

// Reads a range as the user writes it, `860..880/5` or `860..880`. Throws InputError that says how
// it is written.
TickRange parse_tick_range(std::string_view text);

// Reads one tick. Throws InputError, one line that names file, line and column, and if there is no
// such tick the range of those that there are.
TickSteps read_tick_steps(const std::filesystem::path& file, const TickChoice& choice);

// Reads the ticks of a range. Throws InputError as the one above does, also if one of them is
// missing.
std::vector<TickSteps> read_ticks(const std::filesystem::path& file, const TickRange& range);

// Returns the number of the object on whose formula the ticks have iterations; nothing if they have
// none. Of several objects it is that of the last iteration.
std::optional<std::size_t> formula_of(std::span<const TickSteps> ticks);

}  // namespace tactus::host
