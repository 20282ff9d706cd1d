// A tick, explained in a message of fixed size: which feature holds the proxy, by which planes, and
// how friction and the steps of the loop did. Plain data, copied as bytes. host_tools/explain
// writes every move of a tick; this is the last one, for live telemetry and recordings.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware/telemetry/record.h"
#include "firmware/telemetry/step_times.h"
#include "rendering/contact/watched_contact.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// A plane that holds the goal of the last move.
struct ActivePlane {
  rendering::ExplainedFeature feature;
  // The unit normal toward the proxy; world frame.
  Triple normal_W{};
  // The tool's signed distance from the plane, m; below 0 it is behind the plane.
  double tool_distance_m = 0.0;
  // The Lagrange multiplier, m: how far the plane pushes.
  double multiplier_m = 0.0;

  bool operator==(const ActivePlane&) const = default;
};

// At most three planes are active at once.
inline constexpr std::size_t kMaxActivePlanes = 3;

// The explanation of one tick. Positions are in the world frame, m.
struct Explanation {
  // The number of the tick.
  std::uint64_t tick = 0;
  // LoopTimes::scheduled_ns of the tick.
  std::int64_t time_ns = 0;
  // The kind of contact, the touched object, and its numbers if `is_feature_known`. Formulas have
  // no features.
  rendering::ExplainedFeature feature;
  bool is_feature_known = false;
  rendering::FrictionState friction = rendering::FrictionState::free;
  // The number of straight moves, and of iterations on formulas.
  std::uint16_t moves = 0;
  std::uint16_t iterations = 0;
  // The tool (HIP), the proxy (god-object) and the point of the surface under it (SCP). The latter
  // is the proxy without contact.
  Triple tool_W{};
  Triple proxy_W{};
  Triple surface_W{};
  // The contact normal, and the stretch along it; zero without contact.
  Triple normal_W{};
  double depth_m = 0.0;
  // The active planes of the last move, the first `plane_count`.
  std::array<ActivePlane, kMaxActivePlanes> planes;
  std::uint8_t plane_count = 0;
  // The friction circles of the last move; all are 0 unless `has_circle`.
  bool has_circle = false;
  rendering::ExplainedCircle circle;
  // The times of the steps. They are no result of the tick.
  StepTimes step_ns{};

  bool operator==(const Explanation&) const = default;
};
static_assert(std::is_trivially_copyable_v<Explanation>);

}  // namespace tactus::firmware
