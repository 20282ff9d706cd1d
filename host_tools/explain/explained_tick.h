// A tick, explained: what the shared proxy, the formulas and the feature walks did in it. World
// frame, metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/telemetry/step_times.h"
#include "rendering/contact/watched_contact.h"
#include "rendering/geometry/vector.h"
#include "rendering/touch.h"

namespace tactus::host {

using rendering::ExplainedCircle;
using rendering::ExplainedFeature;

// The reason why a plane holds the goal or does not.
enum class PlaneFate : std::uint8_t {
  active,       // it holds the goal
  not_reached,  // the goal is in front of it
  redundant,    // the goal is on it, but the active planes hold the goal there already
};

// A contact plane of one move.
struct ExplainedPlane {
  ExplainedFeature feature;
  // The point of the surface nearest to the proxy.
  Vec3 surface_W = Vec3::Zero();
  // The plane's unit normal, toward the proxy.
  Vec3 normal_W = Vec3::Zero();
  // The signed distances of the tool and of the nearest point to it from the plane.
  double tool_distance_m = 0.0;
  double goal_distance_m = 0.0;
  // The Lagrange multiplier; 0 unless the plane is active.
  double multiplier_m = 0.0;
  PlaneFate fate = PlaneFate::not_reached;
};

// The end of a straight move of the shared proxy.
enum class MoveEnding : std::uint8_t {
  arrived,   // at its goal
  stopped,   // by a surface
  border,    // where the candidates were not known any more: they are gathered there
  held,      // no move: planes or friction leave no way
  settled,   // no move: the proxy is where it belongs
  put_back,  // the proxy went back to an earlier place of the tick
  cut,       // a limit ended the tick
};

// A straight move of the shared proxy.
struct ExplainedMove {
  // Counts the advances of the tick: force shading repeats it with a shifted goal.
  std::size_t pass = 0;
  // The tool, or where friction makes it seem to be.
  Vec3 tool_W = Vec3::Zero();
  Vec3 from_W = Vec3::Zero();
  Vec3 goal_W = Vec3::Zero();
  Vec3 to_W = Vec3::Zero();
  MoveEnding ending = MoveEnding::arrived;
  // The surface that stopped the move.
  std::optional<ExplainedFeature> stopped_by;
  std::vector<ExplainedPlane> planes;
  rendering::FrictionState friction_before = rendering::FrictionState::free;
  rendering::FrictionState friction = rendering::FrictionState::free;
  // Nothing without contact, or if a surface has another model than the cone.
  std::optional<ExplainedCircle> circle;
};

// The end of a sub-goal on a formula.
enum class IterationEnding : std::uint8_t {
  arrived,  // at its goal
  stopped,  // at the surface before it, or by gliding along the surface
  settled,  // no move: the proxy is where it belongs
  cut,      // a limit ended the tick
  free,     // the contact ended, or there was none
};

// A sub-goal on a formula.
struct ExplainedIteration {
  std::uint32_t object = 0;
  Vec3 from_W = Vec3::Zero();
  Vec3 goal_W = Vec3::Zero();
  Vec3 to_W = Vec3::Zero();
  IterationEnding ending = IterationEnding::arrived;
  // F at `from_W` in the formula's own unit, the normal of its tangent plane there, and the height
  // above the surface to first order; a singular point has no normal and an infinite height.
  double value = 0.0;
  Vec3 normal_W = Vec3::Zero();
  double height_m = 0.0;
  rendering::FrictionState friction = rendering::FrictionState::free;
};

// One tick of one tool.
struct ExplainedTick {
  std::uint64_t number = 0;
  double t_s = 0.0;
  Vec3 tool_W = Vec3::Zero();
  // The proxy before the tick.
  Vec3 from_W = Vec3::Zero();
  rendering::FrictionState friction_before = rendering::FrictionState::free;
  std::vector<ExplainedMove> moves;
  std::vector<ExplainedIteration> iterations;
  std::vector<ExplainedFeature> walked_to;
  // The feature of the shared proxy's hardest contact, if it has one.
  std::optional<ExplainedFeature> feature;
  // The point of the surface under the proxy, in contact.
  Vec3 surface_W = Vec3::Zero();
  rendering::Touch touch;
  // The times of the steps; nothing without a clock.
  std::optional<firmware::StepTimes> step_ns;
};

}  // namespace tactus::host
