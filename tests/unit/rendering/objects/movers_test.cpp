// Objects that move at random. The oracles are the distances from a point to the object's box and
// to every one of its triangles, in the object's own frame.
#include "rendering/objects/movers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>

#include "rendering/geometry/hierarchy_query.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kRough;
using testing::Solid;

class MoversTest : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 31;

  Vec3 vector() { return {unit_(random_), unit_(random_), unit_(random_)}; }
  // Returns a pose that is turned by any angle, or by a little, and up to `far_m` away.
  RigidPose pose(double far_m) {
    const double angle = 3.0 * std::pow(std::abs(unit_(random_)), 4.0);
    return {.rotation = Eigen::AngleAxisd(angle, vector().normalized()).toRotationMatrix(),
            .translation = far_m * vector()};
  }

  // Returns true if the box, of which every corner is the object's, is near.
  static bool may_be_near(const Mover& mover, const Vec3& p_O, double reach_m) {
    return mover.bounds_O.distance(p_O) <= reach_m;
  }

  std::mt19937_64 random_{kSeed};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::unique_ptr<Movers> movers_ = std::make_unique<Movers>();
};

// A ball in its box leaves the corners free: near is what its vertices can be near to.
TEST_F(MoversTest, ABallIsNotNearInTheCornersOfItsBox) {
  const Vec3 away(0.03, -0.02, 0.01);
  testing::Shape shape = testing::icosphere(0.05, 2);
  for (Float3& vertex : shape.vertices) {
    vertex = to_float3(to_vec3(vertex) + away);
  }
  const Solid ball(shape, Sides::one, kRough);
  std::array<Object, 1> objects{ball.object()};
  objects[0].moves = true;
  ASSERT_TRUE(movers_->start(objects));
  const MeshView& mesh = objects[0].mesh;
  const auto distance = [&](const Vec3& p_O) {
    double nearest = 1.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      nearest = std::min(nearest, triangle_of(mesh, t).nearest(p_O).distance);
    }
    return nearest;
  };
  int only_box = 0;
  int far = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    ASSERT_TRUE(movers_->set_pose(0, pose(tick % 2 == 0 ? 0.02 : 0.2), {}));
    movers_->begin_tick(0.0);
    const Mover& mover = movers_->all()[0];
    const Vec3 from_W = mover.X_WO_before.point(away + 0.07 * vector());
    const Vec3 to_W = from_W + 0.1 * vector();
    const double reach_m = 0.02 * std::abs(unit_(random_));
    const Vec3 from_O = mover.X_WO_before.point_in(from_W);
    const Vec3 to_O = mover.X_WO.point_in(to_W);
    SCOPED_TRACE("seed 31, tick " + std::to_string(tick));
    // Inside the ball the surface may be far, and the ball is near.
    const bool outside = (from_O - away).norm() > 0.05;
    if (outside && !mover.was_near(from_W, reach_m)) {
      EXPECT_GT(distance(from_O), reach_m);
      only_box += mover.bounds_O.distance(from_O) <= reach_m ? 1 : 0;
      ++far;
    }
    if (mover.is_passed_by(from_W, (to_W - from_W).norm(), reach_m)) {
      EXPECT_GT(distance(from_O), (to_O - from_O).norm() + reach_m);
    }
  }
  EXPECT_GT(only_box, 50);
  EXPECT_GT(far, only_box + 20);
}

// A long box beside its own origin, a plane, and a sheet that deforms and grows.
TEST_F(MoversTest, AnObjectIsNearWhereItsBoxIs) {
  const Solid block(testing::box({0.02, 0.05, 0.3}), Sides::one, kRough);
  const Solid sheet(testing::flat_sheet(0.01, 4), Sides::two, kRough);
  std::array<Object, 3> objects{block.object(), sheet.object(),
                                Object{.surface = SurfaceKind::primitive,
                                       .primitive = {.kind = PrimitiveKind::plane},
                                       .material = kRough}};
  objects[0].moves = objects[2].moves = true;
  objects[1].moves = objects[1].deforms = true;
  ASSERT_TRUE(movers_->start(objects));
  std::size_t near = 0;
  std::size_t passed_by = 0;
  constexpr int kTicks = 3000;
  for (int tick = 0; tick < kTicks; ++tick) {
    for (std::uint32_t i = 0; i < objects.size() && tick % 3 != 0; ++i) {
      const double far_m = tick % 2 == 0 ? 0.5 : 0.01;
      ASSERT_TRUE(movers_->set_pose(i, pose(far_m), {}));
    }
    ASSERT_TRUE(movers_->move_vertex(1, 3, vector()));
    movers_->begin_tick(0.001 * tick);
    for (const Mover& mover : movers_->all()) {
      const Vec3 from_W = 0.4 * vector();
      const Vec3 to_W = from_W + 0.3 * std::abs(unit_(random_)) * vector();
      const double reach_m = 0.2 * std::abs(unit_(random_));
      const Vec3 from_O = mover.X_WO_before.point_in(from_W);
      const Vec3 to_O = mover.X_WO.point_in(to_W);
      SCOPED_TRACE("seed 31, tick " + std::to_string(tick) + ", object " +
                   std::to_string(mover.object));
      EXPECT_EQ(mover.is_near(to_W, reach_m), may_be_near(mover, to_O, reach_m));
      EXPECT_EQ(mover.was_near(from_W, reach_m), may_be_near(mover, from_O, reach_m));
      near += mover.is_near(to_W, reach_m) ? 1U : 0U;
      if (mover.is_passed_by(from_W, (to_W - from_W).norm(), reach_m)) {
        EXPECT_FALSE(may_be_near(mover, from_O, (to_O - from_O).norm() + reach_m));
        ++passed_by;
      }
    }
  }
  EXPECT_GT(near, kTicks);
  EXPECT_GT(passed_by, kTicks / 4);
}

}  // namespace
}  // namespace tactus::rendering
