// Objects that the outside moves. The oracles are frames of reference: whatever moves together must
// feel the same as at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "rendering/contact/tick_watcher.h"
#include "rendering/limits.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::kRough;
using testing::kSlippery;
using testing::Solid;

constexpr double kMovedTick_s = 1e-3;

Object moving(Object object) {
  object.moves = true;
  return object;
}

Mat3 turned(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

class MovingTest : public ::testing::Test {
 protected:
  void take(const Object& object, double radius_m) {
    objects_ = {moving(object)};
    ASSERT_TRUE(world_->set_scene(objects_, {.tool_radius_m = radius_m}));
  }
  std::vector<Object> objects_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// A plate of a tenth of a millimetre sweeps upward over a tool that stays where it is.
class SweepTest : public MovingTest, public ::testing::WithParamInterface<double> {
 protected:
  void sweep(const Object& plate, double radius_m, double top_m) {
    take(plate, radius_m);
    world_->touch({});
    double height = -0.02;
    bool felt = false;
    while (height < 0.05) {
      const RigidPose pose{.translation = {0.0, height, 0.0}};
      ASSERT_TRUE(world_->set_pose(0, pose, {.linear_W = {0.0, GetParam(), 0.0}}));
      const Touch touch = world_->touch({});
      const double rest = height + top_m + radius_m;
      ASSERT_GE(touch.proxy_W.y(), rest) << "height " << height;
      ASSERT_LE(touch.proxy_W.y(), std::max(0.0, rest) + kMicron) << "height " << height;
      ASSERT_EQ(touch.flags, kTouchClean);
      felt = felt || touch.contact != ContactKind::none;
      height += GetParam() * kMovedTick_s;
    }
    EXPECT_TRUE(felt);
  }
};

TEST_P(SweepTest, AMeshPushesThePointAndTheSphere) {
  const Solid plate(testing::box({0.1, 0.0001, 0.1}), Sides::one, kSlippery);
  sweep(plate.object(), 0.0, 0.00005);
  sweep(plate.object(), 0.002, 0.00005);
}

TEST_P(SweepTest, AFineMeshPushesThePointAndTheSphere) {
  const Solid plate(testing::sliver_box({0.1, 0.0001, 0.1}, 0.0002), Sides::one, kSlippery);
  sweep(plate.object(), 0.0, 0.00005);
  sweep(plate.object(), 0.002, 0.00005);
}

TEST_P(SweepTest, ABoxWithoutAMeshPushesThePointAndTheSphere) {
  const Object plate{.surface = SurfaceKind::primitive,
                     .primitive = {.kind = PrimitiveKind::box, .dimensions_m = {0.05, 5e-5, 0.05}},
                     .material = kSlippery};
  sweep(plate, 0.0, 0.00005);
  sweep(plate, 0.002, 0.00005);
}

INSTANTIATE_TEST_SUITE_P(MetresPerSecond, SweepTest, ::testing::Values(0.01, 0.1, 1.0, 5.0));

TEST_F(MovingTest, APaddleAtFortyRadiansPerSecondKeepsThePointAndTheSphereOnItsFrontSide) {
  const Solid paddle(testing::box({0.3, 0.001, 0.1}), Sides::one, kRough);
  for (const double radius_m : {0.0, 0.002}) {
    take(paddle.object(), radius_m);
    const Vec3 tool(0.1, 0.03, 0.0);
    world_->touch({.p_W = tool});
    for (double t = 0.0; t < 0.03; t += kMovedTick_s) {
      const RigidPose pose{.rotation = turned(Vec3::UnitZ(), 40.0 * t)};
      ASSERT_TRUE(world_->set_pose(0, pose, {.angular_W = {0.0, 0.0, 40.0}}));
      const Touch touch = world_->touch({.p_W = tool});
      ASSERT_GE(pose.point_in(touch.proxy_W).y(), 0.0005 + radius_m) << "t " << t;
      ASSERT_EQ(touch.flags, kTouchClean);
      ASSERT_LE((touch.proxy_W - tool).norm(), 0.2);
    }
  }
}

TEST_F(MovingTest, AConveyorDragsAStillToolByTheDynamicCoefficientTimesTheDepth) {
  const Solid belt(testing::box({2.0, 0.01, 0.1}), Sides::one, kRough);
  take(belt.object(), 0.002);
  const Vec3 tool(0.0, 0.005, 0.0);  // 2 mm deep
  world_->touch({.p_W = {0.0, 0.02, 0.0}});
  Touch touch;
  for (double t = 0.0; t < 0.5; t += kMovedTick_s) {
    world_->set_pose(0, {.translation = {0.3 * t, 0.0, 0.0}}, {.linear_W = {0.3, 0.0, 0.0}});
    touch = world_->touch({.p_W = tool});
  }
  EXPECT_EQ(touch.friction, FrictionState::slip);
  EXPECT_NEAR(touch.proxy_W.x(), 0.4 * 0.002, kMicron);
  EXPECT_NEAR(touch.proxy_W.y(), 0.007, kMicron);
}

TEST_F(MovingTest, TheDamperFeelsTheVelocityRelativeToTheSurface) {
  const Solid belt(testing::box({2.0, 0.01, 0.1}), Sides::one,
                   {.stiffness_N_per_m = 1000.0, .damping_Ns_per_m = 2.0});
  take(belt.object(), 0.002);
  world_->touch({.p_W = {0.0, 0.02, 0.0}});
  const ToolState tool{.p_W = {0.0, 0.006, 0.0}, .v_W = {0.1, 0.0, 0.0}};
  world_->set_pose(0, {}, {.linear_W = {0.3, 0.0, 0.0}, .angular_W = {0.0, 0.0, 5.0}});
  const Touch touch = world_->touch(tool);
  const Vec3 surface = Vec3(0.3, 0.0, 0.0) + Vec3(0.0, 0.0, 5.0).cross(touch.proxy_W);
  const Vec3 expected = 1000.0 * (touch.proxy_W - tool.p_W) - 2.0 * (tool.v_W - surface);
  EXPECT_LE((touch.force_W - expected).norm(), 1e-12);
}

// The same strokes over the same object, once at rest and once in a frame that tumbles: in the
// object's frame the proxies must agree. Both may rest anywhere within the contact shell.
TEST_F(MovingTest, ATumblingObjectFeelsLikeOneAtRestToATumblingHand) {
  const Solid bumpy(testing::bumpy_sphere(0.05, 4, 0.05), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 0.002}) {
    take(bumpy.object(), radius_m);
    const auto still = std::make_unique<World>();
    ASSERT_TRUE(still->set_scene({&bumpy.object(), 1}, {.tool_radius_m = radius_m}));
    for (int tick = 0; tick < 3000; ++tick) {
      const double t = tick * kMovedTick_s;
      const double around = 1.3 * t;
      const double height = 0.3 * std::sin(0.9 * t);
      const Vec3 direction(std::cos(around), height, std::sin(around));
      const double distance = 0.05 + radius_m + 0.006 * std::cos(3.0 * t);
      const Vec3 tool_O = distance * direction.normalized();
      const RigidPose pose{.rotation = turned({1.0, 2.0, 0.5}, 7.0 * t),
                           .translation = {0.3 * t, 0.1 * std::sin(5.0 * t), 0.0}};
      world_->set_pose(0, pose, {});
      const Touch a = still->touch({.p_W = tool_O});
      const Touch b = world_->touch({.p_W = pose.point(tool_O)});
      ASSERT_LE((a.proxy_W - pose.point_in(b.proxy_W)).norm(), 20 * kMicron) << "tick " << tick;
      ASSERT_EQ(a.flags, b.flags) << "tick " << tick;
    }
  }
}

TEST_F(MovingTest, FormulasWalksAndFieldsMoveTheSameWay) {
  Object ball{.surface = SurfaceKind::primitive,
              .method = ContactMethod::potential_field,
              .primitive = {.kind = PrimitiveKind::sphere, .dimensions_m = {0.03}},
              .material = kSlippery};
  take(ball, 0.002);
  const RigidPose pose{.rotation = turned({0.0, 0.0, 1.0}, 1.0), .translation = {0.2, 0.1, 0.0}};
  world_->touch({.p_W = {0.2, 0.2, 0.0}});
  world_->set_pose(0, pose, {});
  const Touch touch = world_->touch({.p_W = {0.2, 0.13, 0.0}});
  EXPECT_LE((touch.force_W - Vec3(0.0, 2.0, 0.0)).norm(), 1e-9);
  EXPECT_LE((touch.proxy_W - Vec3(0.2, 0.132, 0.0)).norm(), 1e-12);
}

TEST_F(MovingTest, APlaneThatMovesIsWithoutEnd) {
  take({.surface = SurfaceKind::primitive,
        .primitive = {.kind = PrimitiveKind::plane},
        .material = kSlippery},
       0.0);
  world_->touch({.p_W = {-99.0, 0.01, 0.0}});
  for (double shift = 0.0; shift < 50.0; shift += 5.0) {
    ASSERT_TRUE(world_->set_pose(0, {.translation = {shift, 0.001 * shift, 0.0}}, {}));
    const Touch touch = world_->touch({.p_W = {-99.0, -0.001, 0.0}});
    EXPECT_NEAR(touch.proxy_W.y(), 0.001 * shift, kMicron) << "shift " << shift;
  }
}

TEST_F(MovingTest, JawsThatCloseOnTheProxySaySoAndItIsFreeAgainWhenTheyOpen) {
  const Solid jaw(testing::box({0.1, 0.02, 0.1}), Sides::one, kSlippery);
  objects_ = {jaw.object(), moving(jaw.object())};
  ASSERT_TRUE(world_->set_scene(objects_, {.tool_radius_m = 0.002}));
  const auto at = [&](double gap_m) {
    world_->set_pose(1, {.translation = {0.0, 0.02 + gap_m, 0.0}}, {});
    return world_->touch({.p_W = {0.0, 0.0121, 0.0}});
  };
  ASSERT_TRUE(world_->set_pose(1, {.translation = {0.0, 0.03, 0.0}}, {}));
  world_->touch({.p_W = {0.0, 0.012, 0.0}});
  EXPECT_EQ(at(0.0045).flags, kTouchClean);
  std::uint32_t flags = 0;
  for (double gap = 0.0045; gap > 0.001; gap -= 0.0002) {
    const Touch touch = at(gap);
    flags |= touch.flags;
    EXPECT_GE(touch.proxy_W.y(), 0.012) << "through the jaw that stands still";
    EXPECT_LE(touch.force_W.norm(), 10.0);
  }
  EXPECT_NE(flags & kTouchPinched, 0U);
  for (double gap = 0.001; gap < 0.01; gap += 0.0002) {
    at(gap);
  }
  EXPECT_EQ(at(0.01).force_W, Vec3::Zero());
}

TEST_F(MovingTest, APlateThatPushesTheProxyAgainstAWallLetsItSlideAlongTheWall) {
  // A wall x = 0.02 stands; a plate inclined by 45 degrees pushes the proxy into the corner, out of
  // which there is only one way.
  const Solid wall(testing::box({0.02, 0.4, 0.4}), Sides::one, kSlippery);
  const Solid plate(testing::turned(testing::box({0.2, 0.001, 0.2}), Vec3::UnitZ(), 0.7853981634),
                    Sides::one, kSlippery);
  objects_ = {wall.object(), moving(plate.object())};
  ASSERT_TRUE(world_->set_scene(objects_, {.tool_radius_m = 0.002}));
  world_->set_pose(1, {.translation = {0.1, -0.02, 0.0}}, {});
  const Vec3 tool(0.0125, 0.0, 0.0);
  world_->touch({.p_W = tool});
  for (double t = 0.0; t < 0.2; t += kMovedTick_s) {
    const RigidPose pose{.translation = {0.1, -0.02 + 0.5 * t, 0.0}};
    world_->set_pose(1, pose, {});
    const Touch touch = world_->touch({.p_W = tool});
    ASSERT_GE(touch.proxy_W.x(), 0.012) << "t " << t;
    ASSERT_EQ(touch.flags, kTouchClean);
    const Vec3 p_O = pose.point_in(touch.proxy_W);
    ASSERT_GE((p_O.y() - p_O.x()) / std::sqrt(2.0), 0.0005 + 0.002) << "t " << t;
  }
}

TEST_F(MovingTest, APoseThatIsNoneIsRefused) {
  const Solid plate(testing::box({0.1, 0.01, 0.1}), Sides::one, kSlippery);
  objects_ = {plate.object(), moving(plate.object())};
  ASSERT_TRUE(world_->set_scene(objects_, {}));
  EXPECT_FALSE(world_->set_pose(0, {}, {})) << "stands still";
  EXPECT_FALSE(world_->set_pose(2, {}, {})) << "is not there";
  EXPECT_TRUE(world_->set_pose(1, {}, {}));
  EXPECT_FALSE(world_->set_pose(1, {.rotation = 1.001 * Mat3::Identity()}, {}));
  EXPECT_FALSE(world_->set_pose(1, {.rotation = -Mat3::Identity()}, {}));
  EXPECT_FALSE(world_->set_pose(1, {.rotation = Mat3::Constant(std::nan(""))}, {}));
  EXPECT_FALSE(world_->set_pose(1, {.translation = {0.0, 101.0, 0.0}}, {}));
  EXPECT_FALSE(world_->set_pose(1, {}, {.linear_W = {std::nan(""), 0.0, 0.0}}));
}

TEST_F(MovingTest, TheTicksBudgetPaysForCarryingTheProxy) {
  const Solid plate(testing::box({0.1, 0.001, 0.1}), Sides::one, kSlippery);
  take(plate.object(), 0.0);
  world_->touch({.p_W = {0.0, 0.001, 0.0}});
  // The plate comes over the proxy, and no tool moves it afterwards.
  world_->set_pose(0, {.translation = {0.0, 0.002, 0.0}}, {});
  world_->touch({.p_W = Vec3::Constant(std::nan(""))});
  EXPECT_GT(world_->spent_units(), kCostOfMover);
}

TEST_F(MovingTest, ATickWithoutAValidToolStillCarriesTheProxy) {
  const Solid plate(testing::box({0.1, 0.001, 0.1}), Sides::one, kSlippery);
  take(plate.object(), 0.0);
  world_->touch({.p_W = {0.0, 0.001, 0.0}});
  for (int tick = 1; tick <= 10; ++tick) {
    const bool good = tick % 3 != 0;
    world_->set_pose(0, {.translation = {0.0, 0.002 * tick, 0.0}}, {});
    const Touch touch =
        world_->touch({.p_W = good ? Vec3(0.0, 0.001, 0.0) : Vec3::Constant(std::nan(""))});
    if (good) {
      ASSERT_NEAR(touch.proxy_W.y(), 0.0005 + 0.002 * tick, kMicron);
    } else {
      ASSERT_EQ(touch.force_W, Vec3::Zero());
    }
  }
}

TEST(Tools, TenFingersEachFeelWhatTheyWouldFeelAlone) {
  const Solid ball(testing::bumpy_sphere(0.05, 4, 0.05), Sides::one, kRough);
  const auto all = std::make_unique<WorldOf<10>>();
  ASSERT_TRUE(all->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002, .tool_count = 10}));
  std::vector<std::unique_ptr<World>> alone;
  for (int i = 0; i < 10; ++i) {
    alone.push_back(std::make_unique<World>());
    ASSERT_TRUE(alone.back()->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002}));
  }
  std::array<ToolState, 10> tools;
  std::array<Touch, 10> touches;
  for (int tick = 0; tick < 1000; ++tick) {
    for (std::size_t i = 0; i < 10; ++i) {
      const auto finger = static_cast<double>(i);
      const double angle = 0.6 * finger + 0.001 * tick;
      const double distance = 0.054 - 0.003 * std::sin(0.01 * tick + finger);
      tools[i].p_W = distance * Vec3(std::cos(angle), 0.2 * std::sin(3 * angle), std::sin(angle));
    }
    all->touch(tools, touches);
    for (std::size_t i = 0; i < 10; ++i) {
      const Touch own = alone[i]->touch(tools[i]);
      ASSERT_EQ(touches[i].proxy_W, own.proxy_W);
      ASSERT_EQ(touches[i].force_W, own.force_W);
      ASSERT_EQ(touches[i].flags, own.flags);
    }
  }
}

TEST(Tools, AreWatchedEachByItsOwnWatcher) {
  const Solid ball(testing::icosphere(0.05, 3), Sides::one, kRough);
  const auto all = std::make_unique<WorldOf<3>>();
  const auto alone = std::make_unique<World>();
  ASSERT_TRUE(all->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002, .tool_count = 3}));
  ASSERT_TRUE(alone->set_scene({&ball.object(), 1}, {.tool_radius_m = 0.002}));
  const auto left = std::make_unique<ProxyPath>();
  const auto seen_alone = std::make_unique<ProxyPath>();
  // The third tool has no watcher in the list, the second a null one.
  const std::array<TickWatcher*, 2> watchers{left.get(), nullptr};
  std::array<ToolState, 3> tools;
  std::array<Touch, 3> touches;
  for (int tick = 0; tick < 100; ++tick) {
    const double angle = 0.002 * tick;
    const Vec3 p_W = (0.053 - 0.0001 * tick) * Vec3(std::cos(angle), std::sin(angle), 0.1);
    tools = {ToolState{.p_W = p_W}, ToolState{.p_W = -p_W}, ToolState{.p_W = -p_W}};
    left->count = seen_alone->count = 0;
    all->touch(tools, touches, watchers);
    alone->touch(tools[0], seen_alone.get());
    ASSERT_EQ(left->count, seen_alone->count);
    for (std::size_t i = 0; i < left->count; ++i) {
      ASSERT_EQ(left->points[i], seen_alone->points[i]);
    }
  }
  EXPECT_GT(left->count, 1U);
  ASSERT_EQ(touches[1].force_W, touches[2].force_W);
}

TEST(Tools, ThereIsAtLeastOneAndAreAtMostTen) {
  const Solid ball(testing::icosphere(0.05, 1), Sides::one, kRough);
  const auto world = std::make_unique<WorldOf<10>>();
  EXPECT_FALSE(world->set_scene({&ball.object(), 1}, {.tool_count = 0}));
  EXPECT_FALSE(world->set_scene({&ball.object(), 1}, {.tool_count = 11}));
}

// Returns the place of an object in a cube of ten by ten by ten.
Vec3 place_of(std::size_t number) {
  const std::array<std::size_t, 3> cell{number % 10, number / 10 % 10, number / 100};
  return 0.03 * Vec3(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                     static_cast<double>(cell[2]));
}

TEST(ManyObjects, AThousandFeelLikeTheOneThatIsTouched) {
  // A smaller profile has room for fewer.
  constexpr std::size_t kCount = std::min<std::size_t>(1000, kMaxObjects);
  const Solid ball(testing::icosphere(0.01, 3), Sides::one, kRough);
  std::vector<std::unique_ptr<Solid>> solids;
  std::vector<Object> objects;
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3 place = place_of(i);
    if (i % 2 == 0) {
      solids.push_back(std::make_unique<Solid>(testing::moved(testing::icosphere(0.01, 2), place),
                                               Sides::one, kRough));
      objects.push_back(solids.back()->object());
    } else {
      objects.push_back({.surface = SurfaceKind::primitive,
                         .primitive = {.kind = PrimitiveKind::sphere,
                                       .X_WO = {.translation = place},
                                       .dimensions_m = {0.01}},
                         .material = kRough});
    }
  }
  const auto all = std::make_unique<World>();
  const auto one = std::make_unique<World>();
  ASSERT_TRUE(all->set_scene(objects, {.tool_radius_m = 0.002}));
  for (const std::size_t number : {std::size_t{0}, 345 % kCount, kCount - 1, 444 % kCount}) {
    ASSERT_TRUE(one->set_scene({&objects[number], 1}, {.tool_radius_m = 0.002}));
    all->reset();
    const Vec3 centre = place_of(number);
    for (int tick = 0; tick < 2000; ++tick) {
      const double angle = 0.003 * tick;
      const double distance = 0.0125 - 0.002 * std::sin(0.01 * tick);
      const Vec3 tool =
          centre + distance * Vec3(std::cos(angle), std::sin(angle), 0.1).normalized();
      const Touch a = all->touch({.p_W = tool});
      const Touch b = one->touch({.p_W = tool});
      ASSERT_LE((a.proxy_W - b.proxy_W).norm(), 2 * kMicron) << number << ", tick " << tick;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
