// Explained ticks of a controller: against the closed form of a tool in a corner of planes, against
// the same ticks without an explanation.
#include "firmware/telemetry/tick_explainer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "firmware/control/controller.h"
#include "tests/support/materials.h"
#include "tests/support/without_sign_check.h"

namespace tactus::firmware {
namespace {

using rendering::ContactKind;
using rendering::FrictionState;
using rendering::Object;

// The proxy of a plane rests this far above it (rendering/contact/README.md), m.
constexpr double kRestHeight_m = 0.5e-6;
constexpr double kTolerance_m = 1e-9;
constexpr double kExplainedRadius_m = 0.002;

// Returns a half-space below 0 along one of the axes.
Object wall(int axis, const rendering::Material& material) {
  Object object{.surface = rendering::SurfaceKind::primitive,
                .primitive = {.kind = rendering::PrimitiveKind::plane},
                .material = material};
  // The plane's normal is the second column.
  Mat3& rotation = object.primitive.X_WO.rotation;
  rotation.col(1) = Vec3::Unit(axis);
  rotation.col(0) = Vec3::Unit((axis + 1) % 3);
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
  return object;
}

std::uint64_t ticking_ns() {
  static std::uint64_t ticked_ns = 0;
  return ticked_ns += 10;
}

// A Cartesian device in a corner: walls that bound x, y and z from below.
class ExplainedCorner : public ::testing::Test {
 protected:
  explicit ExplainedCorner(const rendering::Material& material = testing::kRough)
      : walls_{wall(0, material), wall(1, material), wall(2, material)} {
    for (Controller* controller : {&*watched_, &*plain_}) {
      EXPECT_TRUE(controller->configure(testing::without_sign_check(cartesian_config())));
      EXPECT_TRUE(controller->load_scene(walls_, {.tool_radius_m = kExplainedRadius_m}));
      drive(*controller, {0.01, 0.01, 0.01}, Request::home);
      drive(*controller, {0.01, 0.01, 0.01}, Request::none);
      drive(*controller, {0.01, 0.01, 0.01}, Request::enable);
    }
  }

  static void drive(Controller& controller, const Triple& tool, Request request = Request::none) {
    drivers::JointSample sample;
    std::ranges::copy(tool, sample.position.begin());
    controller.tick(sample, request);
  }

  // Explains one tick, in which both controllers must do the same.
  const Explanation& explain(const Triple& tool) {
    explainer_.begin(ticking_ns);
    watched_->watch(&explainer_);
    drive(*watched_, tool);
    explanation_ = explainer_.finish(watched_->record(), 5, watched_->tool_radius_m());
    watched_->watch(nullptr);
    drive(*plain_, tool);
    EXPECT_EQ(watched_->record().state_hash, plain_->record().state_hash);
    return explanation_;
  }

  std::array<Object, 3> walls_;
  std::unique_ptr<Controller> watched_ = std::make_unique<Controller>();
  std::unique_ptr<Controller> plain_ = std::make_unique<Controller>();
  TickExplainer explainer_;
  Explanation explanation_;
};

TEST_F(ExplainedCorner, IsFreeAwayFromTheWalls) {
  const Explanation& tick = explain({0.01, 0.01, 0.01});
  EXPECT_EQ(tick.feature.kind, ContactKind::none);
  EXPECT_EQ(tick.plane_count, 0U);
  EXPECT_FALSE(tick.has_circle);
  EXPECT_EQ(tick.surface_W, tick.proxy_W);
  EXPECT_EQ(tick.tool_W, tick.proxy_W);
  EXPECT_EQ(tick.time_ns, 5);
}

class SlipperyCorner : public ExplainedCorner {
 protected:
  SlipperyCorner() : ExplainedCorner(testing::kSlippery) {}
};

// The proxy is the nearest point in front of all three walls, so each multiplier is the tool's
// depth below its wall.
TEST_F(SlipperyCorner, HasTheWallsThatHoldItWithTheirMultipliers) {
  explain({0.005, 0.005, 0.005});
  const Triple depth_m = {0.001, 0.002, 0.003};
  const double above_m = kExplainedRadius_m + kRestHeight_m;
  const Triple tool = {above_m - depth_m[0], above_m - depth_m[1], above_m - depth_m[2]};
  explain(tool);
  const Explanation& tick = explain(tool);
  ASSERT_EQ(tick.plane_count, 3U);
  for (const ActivePlane& plane : tick.planes) {
    const std::size_t axis = plane.feature.object;
    ASSERT_LT(axis, depth_m.size());
    EXPECT_EQ(plane.feature.kind, ContactKind::face);
    EXPECT_NEAR(plane.normal_W[axis], 1.0, kTolerance_m);
    EXPECT_NEAR(plane.tool_distance_m, -depth_m[axis], kTolerance_m);
    EXPECT_NEAR(plane.multiplier_m, depth_m[axis], kTolerance_m);
  }
  EXPECT_EQ(tick.feature.object, 2U);
  EXPECT_TRUE(tick.is_feature_known);
  EXPECT_NEAR(tick.surface_W[2], 0.0, 1e-6);
  EXPECT_NEAR(tick.proxy_W[2], above_m, kTolerance_m);
}

// The friction of one wall makes circles of mu times the depth.
TEST_F(ExplainedCorner, ShowsTheFrictionCircleOfOneWallAndWhenItSlips) {
  constexpr double kDepth_m = 0.002;
  constexpr double kStep_m = 1.1e-5;
  const double y = kExplainedRadius_m + kRestHeight_m - kDepth_m;
  explain({0.01, 0.005, 0.01});
  explain({0.01, y, 0.01});
  int slipped_at = 0;
  for (int step = 1; step <= 150 && slipped_at == 0; ++step) {
    const double lag_m = kStep_m * step;
    const Explanation& tick = explain({0.01 + lag_m, y, 0.01});
    ASSERT_TRUE(tick.has_circle);
    EXPECT_NEAR(tick.circle.static_radius_m, 0.6 * kDepth_m, kTolerance_m);
    EXPECT_NEAR(tick.circle.dynamic_radius_m, 0.4 * kDepth_m, kTolerance_m);
    if (tick.friction == FrictionState::slip) {
      slipped_at = step;
    } else {
      EXPECT_EQ(tick.friction, FrictionState::stick);
      EXPECT_NEAR(tick.circle.lag_m, lag_m, 1e-8);
    }
  }
  EXPECT_EQ(slipped_at, 110);
}

TEST_F(ExplainedCorner, TimesTheStepsOfTheTouchAndNothingWithoutAClock) {
  const Explanation& tick = explain({0.001, 0.001, 0.001});
  for (const auto step : {rendering::TickStep::collision, rendering::TickStep::proxy,
                          rendering::TickStep::force, rendering::TickStep::objects}) {
    EXPECT_GT(tick.step_ns[static_cast<std::size_t>(step)], 0U) << static_cast<int>(step);
  }
  explainer_.begin(nullptr);
  watched_->watch(&explainer_);
  drive(*watched_, {0.001, 0.001, 0.001});
  EXPECT_EQ(explainer_.finish(watched_->record(), 0, kExplainedRadius_m).step_ns, StepTimes{});
}

}  // namespace
}  // namespace tactus::firmware
