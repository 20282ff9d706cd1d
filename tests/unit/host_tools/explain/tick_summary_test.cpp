// The explanation that the loop makes, in a message of fixed size, against that of the whole tick:
// two programs that watch two worlds with the same tool.
#include "host_tools/explain/tick_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "firmware/telemetry/tick_explainer.h"
#include "host_tools/explain/explainer.h"
#include "rendering/world/world.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::host {
namespace {

using firmware::Explanation;
using firmware::to_triple;
using rendering::ContactMethod;
using rendering::Object;
using rendering::World;

constexpr double kTool_m = 0.002;

// Returns the touch as a controller records it.
firmware::TelemetryRecord record_of(std::size_t tick, const Vec3& tool,
                                    const rendering::Touch& touch) {
  firmware::TelemetryRecord record;
  record.tick = tick;
  record.tool_p_W = to_triple(tool);
  record.proxy_W = to_triple(touch.proxy_W);
  record.normal_W = to_triple(touch.normal_W);
  record.depth_m = touch.depth_m;
  record.contact = touch.contact;
  record.friction = touch.friction;
  record.object = touch.object;
  return record;
}

class TickSummary : public ::testing::TestWithParam<ContactMethod> {
 protected:
  // Strokes about a ball, into it and out of it, and compares the two explanations of every tick.
  // Returns the number of ticks whose feature is known.
  int stroke(const Object& object) {
    constexpr std::size_t kTicks = 900;
    EXPECT_TRUE(whole_world_->set_scene({&object, 1}, {.tool_radius_m = kTool_m}));
    EXPECT_TRUE(loop_world_->set_scene({&object, 1}, {.tool_radius_m = kTool_m}));
    Explainer whole(kTool_m);
    firmware::TickExplainer loop;
    int known = 0;
    for (std::size_t tick = 0; tick < kTicks; ++tick) {
      const Vec3 tool = tool_at(tick);
      whole.begin();
      const rendering::Touch touch = whole_world_->touch({.p_W = tool}, &whole);
      const Explanation summary = summary_of(whole.finish(tick, 0.0, tool, touch));
      loop.begin(nullptr);
      const rendering::Touch again = loop_world_->touch({.p_W = tool}, &loop);
      const Explanation live = loop.finish(record_of(tick, tool, again), 0, kTool_m);
      EXPECT_EQ(first_difference(summary, live), "") << "tick " << tick;
      EXPECT_EQ(live.feature.kind, touch.contact) << "tick " << tick;
      known += live.is_feature_known ? 1 : 0;
    }
    return known;
  }

  static Vec3 tool_at(std::size_t tick) {
    const double angle = 0.01 * static_cast<double>(tick);
    const double r = 0.0205 + 0.0025 * std::cos(1.7 * angle);
    return {r * std::cos(angle), r * std::sin(angle), 0.2 * r * std::sin(3.0 * angle)};
  }

  std::unique_ptr<World> whole_world_ = std::make_unique<World>();
  std::unique_ptr<World> loop_world_ = std::make_unique<World>();
};

TEST_P(TickSummary, OfTheLoopIsThatOfTheWholeTick) {
  const testing::ConnectedSolid ball(testing::icosphere(0.02, 3));
  const rendering::ConnectedMesh mesh = ball.mesh();
  const Object object{.method = GetParam(),
                      .mesh = mesh.mesh,
                      .neighbours = mesh.neighbours,
                      .vertex_normals = mesh.vertex_normals,
                      .material = testing::kRough};
  const int known = stroke(object);
  if (GetParam() != ContactMethod::potential_field) {
    EXPECT_GT(known, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(OnMeshes, TickSummary,
                         ::testing::Values(ContactMethod::sphere_proxy, ContactMethod::god_object,
                                           ContactMethod::potential_field,
                                           ContactMethod::feature_walk, ContactMethod::one_plane,
                                           ContactMethod::three_sub_goals,
                                           ContactMethod::three_step, ContactMethod::one_step));

TEST(TickSummaryDifference, NamesTheFieldAndLeavesOutTheTimes) {
  Explanation one{.tick = 4, .plane_count = 2};
  one.planes[0].multiplier_m = 1e-3;
  Explanation other = one;
  other.time_ns = 7;
  other.step_ns[3] = 12;
  std::swap(other.planes[0], other.planes[1]);
  EXPECT_EQ(first_difference(one, other), "");
  other.planes[0].tool_distance_m = -1e-12;
  EXPECT_EQ(first_difference(one, other), "planes");
  other = one;
  other.surface_W[1] = 0.5;
  EXPECT_EQ(first_difference(one, other), "surface");
}

}  // namespace
}  // namespace tactus::host
