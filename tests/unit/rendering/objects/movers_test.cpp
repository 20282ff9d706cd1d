// Objects that move at random. The oracle is the distance from a point to the object's box in the
// object's own frame.
#include "rendering/objects/movers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>

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

  std::mt19937_64 random_{kSeed};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::unique_ptr<Movers> movers_ = std::make_unique<Movers>();
};

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
      EXPECT_EQ(mover.is_near(to_W, reach_m), mover.bounds_O.distance(to_O) <= reach_m);
      EXPECT_EQ(mover.was_near(from_W, reach_m), mover.bounds_O.distance(from_O) <= reach_m);
      near += mover.is_near(to_W, reach_m) ? 1U : 0U;
      if (mover.is_passed_by(from_W, (to_W - from_W).norm(), reach_m)) {
        EXPECT_GT(mover.bounds_O.distance(from_O), (to_O - from_O).norm() + reach_m);
        ++passed_by;
      }
    }
  }
  EXPECT_GT(near, kTicks);
  EXPECT_GT(passed_by, kTicks / 4);
}

}  // namespace
}  // namespace tactus::rendering
