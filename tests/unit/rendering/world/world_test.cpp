#include "rendering/world/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "rendering/limits.h"
#include "rendering/state_archive.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::kSlippery;
using testing::Solid;

testing::Shape plate_shape(double half_m, double z_m) {
  testing::Shape plate{.name = "plate", .closed = false};
  const auto h = static_cast<float>(half_m);
  const auto z = static_cast<float>(z_m);
  plate.vertices = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  return plate;
}

class WorldTest : public ::testing::Test {
 protected:
  // A tick's budget, in instructions, that fast motions and dense places reach.
  static constexpr double kLittle = 40e3;

  Touch start(const Solid& solid, double radius_m, const Vec3& tool) {
    EXPECT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = radius_m}));
    return world_->touch({.p_W = tool});
  }
  Touch touch(const Vec3& tool, const Vec3& velocity = Vec3::Zero()) {
    return world_->touch({.p_W = tool, .v_W = velocity});
  }

  std::unique_ptr<World> world_ = std::make_unique<World>();
};

TEST_F(WorldTest, ForceIsStiffnessTimesStretchMinusDampingTimesVelocity) {
  const Solid plate(plate_shape(0.1, 0.0), Sides::one,
                    {.stiffness_N_per_m = 800.0, .damping_Ns_per_m = 0.5});
  start(plate, 0.002, {0.0, 0.0, 0.01});
  const Vec3 tool{0.001, 0.002, -0.001};
  const Vec3 velocity{0.01, 0.0, -0.1};
  const Touch t = touch(tool, velocity);
  EXPECT_EQ(t.force_W, Vec3(800.0 * (t.proxy_W - tool) - 0.5 * velocity));
  EXPECT_NEAR(t.depth_m, 0.003, kMicron);
  EXPECT_EQ(t.contact, ContactKind::face);
  EXPECT_LE((t.normal_W - Vec3::UnitZ()).norm(), 1e-12);
}

TEST_F(WorldTest, ADamperNeverPullsTheToolIntoTheSurface) {
  const Solid plate(plate_shape(0.1, 0.0), Sides::one,
                    {.stiffness_N_per_m = 800.0, .damping_Ns_per_m = 3.0});
  std::array objects{plate.object(), plate.object(), plate.object()};
  objects[1].method = ContactMethod::god_object;
  objects[2].method = ContactMethod::potential_field;
  objects[2].surface = SurfaceKind::primitive;
  objects[2].primitive = {.kind = PrimitiveKind::box, .dimensions_m = {0.1, 0.1, 0.05}};
  objects[2].primitive.X_WO.translation = {0.0, 0.0, -0.05};
  for (const Object& object : objects) {
    ASSERT_TRUE(world_->set_scene({&object, 1}, {.tool_radius_m = 0.002}));
    touch({0.0, 0.0, 0.01});
    bool has_pulled = false;
    for (double z = -0.001; z < 0.003; z += 0.28e-3) {
      const Touch t = touch({0.0, 0.0, z}, {0.02, 0.0, 0.28});
      EXPECT_GE(t.force_W.dot(t.normal_W), 0.0) << "z " << z;
      // The rest of the damper still resists.
      if (t.contact != ContactKind::none) {
        EXPECT_NEAR(t.force_W.x(), -0.06, 1e-12);
        has_pulled = has_pulled || 800.0 * t.depth_m < 0.84;
      }
    }
    EXPECT_TRUE(has_pulled) << "the path is to come where the damper is stronger than the spring";
  }
}

TEST_F(WorldTest, AWallATenthOfAMillimetreThickStopsAToolAtFiveMetresASecond) {
  const Solid wall(testing::box({0.1, 0.1, 0.0001}), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 0.002}) {
    start(wall, radius_m, {0.003, 0.002, 0.02});
    double z = 0.02;
    for (int tick = 0; tick < 20; ++tick) {
      z -= 0.005;
      const Touch t = touch({0.003, 0.002, z});
      ASSERT_GE(t.proxy_W.z(), 0.00005 + radius_m);
    }
  }
}

TEST_F(WorldTest, AOneSidedMeshLetsTheToolOutAndNotInAgain) {
  const Solid box(testing::box({0.04, 0.04, 0.04}), Sides::one, kSlippery);
  EXPECT_EQ(start(box, 0.002, Vec3::Zero()).force_W, Vec3::Zero());
  for (double z = 0.0; z < 0.03; z += 0.0005) {
    EXPECT_LE(touch({0.0, 0.0, z}).force_W.norm(), 1000.0 * 20 * kMicron) << "z " << z;
  }
  EXPECT_NEAR(touch({0.0, 0.0, 0.01}).proxy_W.z(), 0.022, kMicron);
}

TEST_F(WorldTest, ATwoSidedMeshKeepsTheToolWhereItIs) {
  const Solid box(testing::box({0.04, 0.04, 0.04}), Sides::two, kSlippery);
  start(box, 0.002, Vec3::Zero());
  EXPECT_NEAR(touch({0.0, 0.0, 0.05}).proxy_W.z(), 0.018, kMicron);
}

TEST_F(WorldTest, APinchedSphereRestsOnBothEdgesOfASlot) {
  // Two edges a gap g apart carry a sphere of radius r at a height of sqrt(r^2 - g^2 / 4).
  const Solid block(testing::slotted_block(0.0015, 0.02), Sides::one, kSlippery);
  start(block, 0.002, {0.0002, 0.01, 0.0});
  const Touch t = touch({0.0, -0.005, 0.0});
  EXPECT_NEAR(t.proxy_W.y(), std::sqrt(0.002 * 0.002 - 0.00075 * 0.00075), 2 * kMicron);
  EXPECT_NEAR(t.proxy_W.x(), 0.0, kMicron);
  EXPECT_EQ(t.planes, 2);
}

TEST_F(WorldTest, FrictionIsTheSameOverASeamAsOnAFace) {
  // Sliding straight across the diagonal between two coplanar triangles: the lag stays mu times
  // depth at every step.
  const Solid plate(plate_shape(0.1, 0.0), Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = cone_friction(0.5, 0.5)});
  for (const double radius_m : {0.0, 0.002}) {
    start(plate, radius_m, {-0.01, 0.0, 0.01 + radius_m});
    for (int tick = 0; tick < 4000; ++tick) {
      const double x = -0.01 + 5e-6 * tick;
      const Touch t = touch({x, 0.0, radius_m - 0.002});
      if (tick > 300) {
        ASSERT_EQ(t.friction, FrictionState::slip) << "x " << x;
        ASSERT_NEAR(x - t.proxy_W.x(), 0.5 * 0.002, kMicron) << "x " << x;
      }
    }
  }
}

TEST_F(WorldTest, AToolThatIsNotANumberGivesNoForceAndTheNextGoodOneIsFeltAgain) {
  const Solid plate(plate_shape(0.1, 0.0), Sides::one, kSlippery);
  start(plate, 0.0, {0.0, 0.0, 0.01});
  const Touch good = touch({0.0, 0.0, -0.002});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e6}) {
    const Touch t = touch({bad, 0.0, -0.002});
    EXPECT_EQ(t.force_W, Vec3::Zero());
    EXPECT_EQ(t.flags, kTouchToolInvalid);
    EXPECT_EQ(t.proxy_W, good.proxy_W);
    EXPECT_EQ(touch({0.0, 0.0, -0.002}).force_W, good.force_W);
  }
}

TEST_F(WorldTest, EachObjectIsFeltWithItsOwnMaterial) {
  const Solid soft(testing::moved(plate_shape(0.05, 0.0), {-0.06, 0, 0}), Sides::one,
                   {.stiffness_N_per_m = 200.0});
  const Solid hard(testing::moved(plate_shape(0.05, 0.0), {0.06, 0, 0}), Sides::one,
                   {.stiffness_N_per_m = 2000.0});
  const std::array objects{soft.object(), hard.object()};
  ASSERT_TRUE(world_->set_scene(objects, {.tool_radius_m = 0.001}));
  touch({-0.06, 0.0, 0.01});
  const Touch on_soft = touch({-0.06, 0.0, 0.0});
  EXPECT_NEAR(on_soft.force_W.z(), 0.2, 1e-3);
  EXPECT_EQ(on_soft.object, 0U);
  touch({0.06, 0.0, 0.01});
  const Touch on_hard = touch({0.06, 0.0, 0.0});
  EXPECT_NEAR(on_hard.force_W.z(), 2.0, 1e-2);
  EXPECT_EQ(on_hard.object, 1U);
}

TEST_F(WorldTest, RefusesASceneBeyondItsLimits) {
  const Solid plate(plate_shape(0.1, 0.0), Sides::one, kSlippery);
  const std::vector<Object> many(kMaxObjects + 1, plate.object());
  EXPECT_FALSE(world_->set_scene(many, {}));
  EXPECT_FALSE(world_->set_scene({&plate.object(), 1}, {.tool_radius_m = -1.0}));
  EXPECT_FALSE(world_->set_scene({&plate.object(), 1}, {.tool_radius_m = 1.001}));
  EXPECT_TRUE(world_->set_scene({many.data(), kMaxObjects}, {}));
}

TEST_F(WorldTest, MoreTrianglesThanFitMakeTheProxyHoldStillAndAreCounted) {
  // A cone of 4000 slender triangles that all meet in the apex.
  const Solid cone(testing::cone(4000, 0.02, 0.02), Sides::one, kSlippery);
  start(cone, 0.001, {0.0, 0.0, 0.03});
  std::uint32_t flags = 0;
  for (int tick = 0; tick < 100; ++tick) {  // it takes more than one to see that they are too many
    const Touch t = touch({0.0, 0.0, 0.005});
    flags |= t.flags;
    ASSERT_GE(t.proxy_W.z(), 0.011);
    ASSERT_TRUE(t.force_W.allFinite());
  }
  EXPECT_NE(flags & kTouchCandidatesOverflow, 0U);
}

TEST_F(WorldTest, InADensePlaceTheProxyWaitsForSomeTicksAndIsFeltMeanwhile) {
  // A bowl little larger than the tool has hundreds of triangles about it wherever it rests.
  constexpr double kBowl_m = 0.0022;
  constexpr double kTool_m = 0.002;
  const Solid bowl(testing::icosphere(kBowl_m, 4), Sides::two, kSlippery);
  start(bowl, kTool_m, Vec3::Zero());
  ASSERT_TRUE(world_->set_tick_budget(kLittle));
  for (int tick = 0; tick < 100; ++tick) {
    touch({0.0, 0.0, -0.0005});
  }
  int waits = 0;
  Vec3 tool;
  for (int tick = 0; tick < 400; ++tick) {
    const double angle = 0.002 * tick;
    tool = 0.0005 * Vec3{std::sin(angle), 0.0, -std::cos(angle)};
    const Touch t = touch(tool);
    waits += t.flags == kTouchIterationsExhausted ? 1 : 0;
    ASSERT_LE(t.proxy_W.norm(), kBowl_m - kTool_m);
    ASSERT_GT(t.planes, 0U) << "tick " << tick;
    ASSERT_NEAR(t.force_W.norm(), 0.3, 0.03) << "tick " << tick;
  }
  EXPECT_GT(waits, 2);
  Touch last;
  for (int tick = 0; tick < 100; ++tick) {
    last = touch(tool);
  }
  EXPECT_EQ(last.flags, kTouchClean);
  constexpr double kFacets_m = 5 * kMicron;
  EXPECT_LE((last.proxy_W - (kBowl_m - kTool_m) * tool.normalized()).norm(), kFacets_m);
}

// The gathering that has begun is part of the state.
TEST_F(WorldTest, AStateThatIsSavedWhileTheProxyWaitsGoesOnAlike) {
  constexpr double kBowl_m = 0.0022;
  constexpr double kTool_m = 0.002;
  constexpr std::size_t kRoom = 1 << 20;
  const Solid bowl(testing::icosphere(kBowl_m, 4), Sides::two, kSlippery);
  start(bowl, kTool_m, Vec3::Zero());
  ASSERT_TRUE(world_->set_tick_budget(kLittle));
  const auto other = std::make_unique<World>();
  ASSERT_TRUE(other->set_scene({&bowl.object(), 1}, {.tool_radius_m = kTool_m}));
  ASSERT_TRUE(other->set_tick_budget(kLittle));
  std::vector<std::byte> room(kRoom);
  int waits = 0;
  for (int tick = 0; tick < 400; ++tick) {
    const double angle = 0.002 * tick;
    const Vec3 tool = 0.0005 * Vec3{std::sin(angle), 0.0, -std::cos(angle)};
    StateArchive saved = StateArchive::writer(room);
    world_->transfer(saved);
    ASSERT_TRUE(saved.good());
    StateArchive restored = StateArchive::reader(std::span(room).first(saved.size()));
    other->transfer(restored);
    ASSERT_TRUE(restored.good() && restored.at_end());
    const Touch t = touch(tool);
    const Touch again = other->touch({.p_W = tool});
    ASSERT_EQ(again.proxy_W, t.proxy_W) << "tick " << tick;
    ASSERT_EQ(again.force_W, t.force_W) << "tick " << tick;
    ASSERT_EQ(again.flags, t.flags) << "tick " << tick;
    waits += t.flags == kTouchIterationsExhausted ? 1 : 0;
  }
  EXPECT_GT(waits, 2);
}

// Rushed over many triangles, the proxy is often between two faces when a tick's budget is spent.
TEST_F(WorldTest, ATickThatIsCutShortIsFeltAsTheOnesBefore) {
  constexpr double kBall_m = 0.05;
  constexpr int kSettled = 200;
  const Solid ball(testing::icosphere(kBall_m, 6), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 0.002}) {
    start(ball, radius_m, {0.06, 0.0, 0.0});
    ASSERT_TRUE(world_->set_tick_budget(kLittle));
    int cut_short = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      const double angle = 0.02 * std::max(0, tick - kSettled) * (tick % 7) / 7.0;
      const double r = 0.06 - std::min(0.012, 0.0001 * tick);
      const Vec3 tool{r * std::cos(angle), r * std::sin(angle), 0.0};
      const Touch t = touch(tool);
      if (tick > kSettled) {
        cut_short += t.flags == kTouchIterationsExhausted ? 1 : 0;
        ASSERT_EQ(t.short_of_goal_m > 0.0, t.flags == kTouchIterationsExhausted);
        ASSERT_LE(t.short_of_goal_m, (t.proxy_W - tool).norm());
        ASSERT_GT(t.planes, 0U) << "tick " << tick << ", radius " << radius_m;
        ASSERT_GT(t.force_W.dot(t.proxy_W), 0.0) << "tick " << tick << ", radius " << radius_m;
      }
    }
    EXPECT_GT(cut_short, 100) << "radius " << radius_m;
  }
}

}  // namespace
}  // namespace tactus::rendering
