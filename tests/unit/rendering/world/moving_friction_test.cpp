// Friction on objects that the outside moves. The oracle is the frame of the object.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "rendering/world/world.h"
#include "tests/unit/rendering/friction/every_kind.h"

namespace tactus::rendering {
namespace {

constexpr double kMovingTick_s = 1e-3;

Mat3 turned_about(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

class MovingFriction : public ::testing::Test {
 protected:
  void take(Object object, double radius_m) {
    object.moves = true;
    objects_ = {object};
    ASSERT_TRUE(world_->set_scene(objects_, {.tool_radius_m = radius_m}));
  }
  std::vector<Object> objects_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// A point that slides over a box with each friction model, once at rest and once in a frame that
// tumbles. Friction belongs to the surface, so that it turns with it.
TEST_F(MovingFriction, FrictionOnATumblingBoxIsThatOfOneAtRest) {
  for (const testing::NamedFriction& kind : testing::every_kind(600.0)) {
    const Object box{.surface = SurfaceKind::primitive,
                     .primitive = {.kind = PrimitiveKind::box, .dimensions_m = {0.1, 0.02, 0.1}},
                     .material = {.stiffness_N_per_m = 600.0, .friction = kind.parameters}};
    take(box, 0.0);
    const auto still = std::make_unique<World>();
    ASSERT_TRUE(still->set_scene({&box, 1}, {}));
    double largest_N = 0.0;
    for (int tick = 0; tick < 1000; ++tick) {
      const double t = tick * kMovingTick_s;
      // In the second half the point stays where it is on the box, and its bristles bent.
      const double s = std::min(t, 0.5);
      const Vec3 tool_O(0.02 * std::sin(9.0 * s), 0.021 - 0.004 * std::sin(2.0 * s),
                        0.02 * std::sin(7.0 * s));
      const RigidPose pose{.rotation = turned_about({1.0, 2.0, 0.5}, 7.0 * t),
                           .translation = {0.3 * t, 0.1 * std::sin(5.0 * t), 0.0}};
      world_->set_pose(0, pose, {});
      const Vec3 expected = still->touch({.p_W = tool_O}).force_W;
      const Vec3 force = pose.direction_in(world_->touch({.p_W = pose.point(tool_O)}).force_W);
      largest_N = std::max(largest_N, (force - expected).norm());
    }
    EXPECT_GT(still->touch({.p_W = {0.0, 0.018, 0.0}}).force_W.norm(), 1.0) << "it presses";
    EXPECT_LE(largest_N, 2e-3) << kind.name;
  }
}

// A ball tool does not turn: a surface that turns about the point of contact does not rub on it.
TEST_F(MovingFriction, ASurfaceThatTurnsAboutTheContactRollsUnderABall) {
  constexpr double kRadius = 0.01;
  for (const testing::NamedFriction& kind : testing::every_kind(1000.0)) {
    take({.surface = SurfaceKind::primitive,
          .primitive = {.kind = PrimitiveKind::box, .dimensions_m = {0.1, 0.02, 0.1}},
          .material = {.stiffness_N_per_m = 1000.0, .friction = kind.parameters}},
         kRadius);
    const Vec3 touched(0.0, 0.02, 0.0);
    const Vec3 tool = touched + Vec3(0.0, kRadius - 1e-3, 0.0);
    world_->touch({.p_W = touched + Vec3(0.0, 2.0 * kRadius, 0.0)});
    for (int tick = 0; tick <= 200; ++tick) {
      const Mat3 rotation = turned_about(Vec3::UnitZ(), 5e-5 * tick);
      world_->set_pose(0, {.rotation = rotation, .translation = touched - rotation * touched}, {});
      const Touch touch = world_->touch({.p_W = tool});
      if (tick > 0) {
        EXPECT_LE((touch.force_W - Vec3::UnitY()).norm(), 3e-3) << kind.name << ", " << tick;
      }
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
