// A ball in a cup of a floor and twelve walls, against statics.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/rendering/bodies/compound_bench.h"

namespace tactus::rendering {
namespace {

constexpr double kCupBall_m = 0.01;
constexpr double kCupBall_kg = 0.005;
constexpr double kRoughPlate = 3.0;

// A cup that stands on a rough plate and does not tip, with a ball at the wall toward +x.
class CupWithABall {
 public:
  explicit CupWithABall(double height_m) : shape_{.height_m = height_m} {
    plate_.make(box_part(Vec3(0.0, -0.01, 0.0), Vec3(0.2, 0.01, 0.2)));
    EXPECT_TRUE(
        bench_.world().add_obstacle({.hull = plate_.hull(), .surface = {.friction = kRoughPlate}}));
    bench_.add_compound(shape_.parts(), {.mass_kg = 0.5, .inertia_C = 5e-4 * Mat3::Identity()}, {},
                        {.friction = kRoughPlate});
    bench_.add_ball(kCupBall_m, kCupBall_kg, Vec3(ball_at_m(), shape_.floor_m + kCupBall_m, 0.0),
                    {.friction = 0.3});
    bench_.run(0.1);
  }

  // Tilts the world slowly, so that +x comes to lie below.
  void tilt(double angle_rad, double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds / kBodyTick_s));
    for (int i = 1; i <= ticks; ++i) {
      const double now = angle_rad * i / ticks;
      bench_.world().set_gravity(kBodyGravity_m_per_s2 * Vec3(std::sin(now), -std::cos(now), 0.0));
      bench_.run(kBodyTick_s);
    }
  }
  // Carries the plate toward -x with a constant acceleration.
  void carry(double acceleration, double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds / kBodyTick_s));
    for (int i = 0; i < ticks; ++i) {
      speed_ -= acceleration * kBodyTick_s;
      bench_.world().set_obstacle(0, {.translation = Vec3(place_, 0.0, 0.0)},
                                  {.linear_W = Vec3(speed_, 0.0, 0.0)});
      bench_.run(kBodyTick_s);
      place_ += speed_ * kBodyTick_s;
    }
  }
  // Returns the place of the ball, seen from the cup.
  [[nodiscard]] Vec3 ball() const {
    return bench_.body(0).pose().point_in(bench_.body(1).motion().center_W);
  }
  // Returns true if the ball's middle is within the inner circle, and above the floor.
  [[nodiscard]] bool is_inside() const {
    return std::hypot(ball().x(), ball().z()) < shape_.inner_radius_m &&
           ball().y() > shape_.floor_m;
  }
  [[nodiscard]] double ball_at_m() const {
    // A wall that is lower than the ball's middle touches it with its upper edge.
    const double below = std::max(kCupBall_m - shape_.height_m, 0.0);
    return shape_.inner_radius_m - std::sqrt(kCupBall_m * kCupBall_m - below * below);
  }
  BodyBench& bench() { return bench_; }

 private:
  CupShape shape_;
  PrimitiveHull plate_;
  BodyBench bench_;
  double speed_ = 0.0;
  double place_ = 0.0;
};

TEST(Cup, ABallThatIsDroppedIntoItRestsOnItsFloor) {
  const CupShape shape;
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  bench.add_compound(shape.parts(), {.mass_kg = 0.2, .inertia_C = 2e-4 * Mat3::Identity()}, {},
                     {.friction = 0.5, .rolling_m = 1e-4});
  bench.add_ball(kCupBall_m, kCupBall_kg, Vec3(0.012, 0.1, 0.004), {.friction = 0.5});
  bench.run(2.0);
  EXPECT_NEAR(bench.body(1).motion().center_W.y(), shape.floor_m + kCupBall_m, 5e-5);
  EXPECT_LT(bench.body(1).motion().velocity_W.norm(), 1e-4);
  EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-5);
}

// The upper edge of a wall of height h below the ball's middle holds it up to the slope at which
// the middle is above the edge: the cosine is (r - h) / r.
TEST(Cup, ABallLeavesALowWallBeyondTheAngleOfStatics) {
  for (const double height_m : {0.003, 0.005}) {
    const double angle = std::acos((kCupBall_m - height_m) / kCupBall_m);
    CupWithABall held(height_m);
    held.tilt(0.97 * angle, 2.0);
    held.bench().run(0.5);
    EXPECT_TRUE(held.is_inside()) << height_m;
    EXPECT_NEAR(held.ball().x(), held.ball_at_m(), 3e-4) << height_m;
    CupWithABall lost(height_m);
    lost.tilt(1.03 * angle, 2.0);
    lost.bench().run(0.5);
    EXPECT_FALSE(lost.is_inside()) << height_m;
  }
}

// A wall above the ball's middle holds it up to a right angle.
TEST(Cup, ABallStaysBehindAHighWallUpToARightAngle) {
  CupWithABall cup(0.02);
  cup.tilt(1.2, 2.0);
  cup.bench().run(0.5);
  EXPECT_TRUE(cup.is_inside());
  EXPECT_NEAR(cup.ball().y(), 0.015, 3e-4);
}

// Carrying with the acceleration a is a tilt of atan(a / g).
TEST(Cup, ABallLeavesALowWallThatIsCarriedFasterThanStaticsAllows) {
  constexpr double kHeight_m = 0.005;
  const double tangent = std::tan(std::acos((kCupBall_m - kHeight_m) / kCupBall_m));
  CupWithABall held(kHeight_m);
  held.carry(0.96 * tangent * kBodyGravity_m_per_s2, 0.5);
  EXPECT_TRUE(held.is_inside());
  CupWithABall lost(kHeight_m);
  lost.carry(1.04 * tangent * kBodyGravity_m_per_s2, 0.5);
  EXPECT_FALSE(lost.is_inside());
}

}  // namespace
}  // namespace tactus::rendering
