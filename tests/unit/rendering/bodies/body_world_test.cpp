// Bodies on planes and on each other, against the closed forms of mechanics.
#include "rendering/bodies/body_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/support/share.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

using testing::part_of;

TEST(BodyWorld, ABoxSlidesDownASlopeBeyondTheAngleOfFriction) {
  constexpr double kFriction = 0.5;
  for (const double factor : {0.995, 1.005, 1.3}) {
    const BodySlope slope{std::atan(kFriction) * factor};
    BodyBench bench;
    bench.add_plane(slope.normal, kFriction);
    bench.add_box(Vec3(0.02, 0.005, 0.02), 0.1, slope.box_at(0.005), kFriction);
    bench.run(0.1);
    const Vec3 start = bench.body(0).motion().center_W;
    const double speed = bench.body(0).motion().velocity_W.dot(slope.down);
    bench.run(0.5);
    const double gained = bench.body(0).motion().velocity_W.dot(slope.down) - speed;
    const double expected =
        kBodyGravity_m_per_s2 * (std::sin(slope.angle) - kFriction * std::cos(slope.angle)) * 0.5;
    if (factor < 1.0) {
      EXPECT_LT((bench.body(0).motion().center_W - start).norm(), 1e-6) << "it rests";
    } else {
      EXPECT_NEAR(gained, expected, 0.005 * expected + 1e-4) << factor;
    }
  }
}

TEST(BodyWorld, ABallRollsDownASlopeWithFiveSevenths) {
  const BodySlope slope{0.3};
  BodyBench bench;
  bench.add_plane(slope.normal, 0.6);
  bench.add_ball(0.02, 0.05, 0.02 * slope.normal, {.friction = 0.6});
  bench.run(1.0);
  const RigidBody& ball = bench.body(0);
  const double expected = 5.0 / 7.0 * kBodyGravity_m_per_s2 * std::sin(slope.angle);
  EXPECT_NEAR(ball.motion().velocity_W.dot(slope.down), expected, 0.005 * expected);
  EXPECT_NEAR(ball.angular_velocity_W().z() * 0.02, expected, 0.005 * expected);
}

TEST(BodyWorld, ABallSlipsWhereTheSlopeIsTooSteepToRoll) {
  constexpr double kFriction = 0.2;
  const BodySlope slope{std::atan(3.5 * kFriction) + 0.1};
  BodyBench bench;
  bench.add_plane(slope.normal, kFriction);
  bench.add_ball(0.02, 0.05, 0.02 * slope.normal, {.friction = kFriction});
  bench.run(0.5);
  const double expected =
      0.5 * kBodyGravity_m_per_s2 * (std::sin(slope.angle) - kFriction * std::cos(slope.angle));
  EXPECT_NEAR(bench.body(0).motion().velocity_W.dot(slope.down), expected, 0.005 * expected);
  EXPECT_LT(bench.body(0).angular_velocity_W().z() * 0.02, 0.9 * expected);
}

TEST(BodyWorld, AStruckBallRollsAfterTwoSeventhsOfItsSpeedAreLost) {
  constexpr double kFriction = 0.3;
  constexpr double kSpeed = 1.0;
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), kFriction);
  bench.add_ball(0.02, 0.05, Vec3(0.0, 0.02, 0.0), {.friction = kFriction}, Vec3(kSpeed, 0.0, 0.0));
  const double rolls_s = 2.0 * kSpeed / (7.0 * kFriction * kBodyGravity_m_per_s2);
  bench.run(0.9 * rolls_s);
  const auto slip = [&] {
    const RigidBody& ball = bench.body(0);
    return ball.velocity_at(ball.motion().center_W - 0.02 * Vec3::UnitY()).x();
  };
  EXPECT_GT(slip(), 0.05 * kSpeed);
  bench.run(0.2 * rolls_s);
  EXPECT_NEAR(slip(), 0.0, 1e-3 * kSpeed);
  EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), 5.0 / 7.0 * kSpeed, 0.005 * kSpeed);
}

// It tips if friction exceeds its width over its height.
TEST(BodyWorld, ABoxTipsBeforeItSlidesWhereFrictionIsLargeEnough) {
  for (const double friction : {0.4, 0.6}) {
    const BodySlope slope{std::atan(0.55)};
    BodyBench bench;
    bench.add_plane(slope.normal, friction);
    bench.add_box(Vec3(0.01, 0.02, 0.01), 0.1, slope.box_at(0.02), friction);
    bench.run(0.2);
    const double lean = bench.body(0).motion().rotation_WO.col(1).dot(slope.normal);
    if (friction > 0.5) {
      EXPECT_LT(lean, 0.99);
    } else {
      EXPECT_GT(lean, 0.9999);
      EXPECT_GT(bench.body(0).motion().velocity_W.dot(slope.down), 0.1);
    }
  }
}

// Creep is what a box moves after it has settled for a second.
TEST(BodyWorld, AStackOfTwentyStandsForAMinuteWithoutCreep) {
  const int boxes = std::max(part_of(20), 2);
  const int seconds = std::max(part_of(60), 3);
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  for (int i = 0; i < boxes; ++i) {
    bench.add_box(Vec3(0.01, 0.01, 0.01), 0.05, {.translation = {0.0, 0.01 + 0.02 * i, 0.0}}, 0.5);
  }
  bench.run(1.0);
  const auto now = bench.world().bodies();
  const std::vector<RigidBody> settled(now.begin(), now.end());
  double creep = 0.0;
  for (int second = 1; second < seconds; ++second) {
    bench.run(1.0);
    for (std::size_t i = 0; i < settled.size(); ++i) {
      const Vec3 moved = bench.body(i).motion().center_W - settled[i].motion().center_W;
      creep = std::max(creep, moved.norm());
    }
  }
  std::printf("a stack of %d boxes creeps by %.2e m in %d s\n", boxes, creep, seconds);
  EXPECT_LT(creep, 1e-4);
  EXPECT_LT(now.back().motion().velocity_W.norm(), 1e-6);
  EXPECT_NEAR(settled.back().motion().center_W.y(), 0.02 * boxes - 0.01, 1e-3);
}

// The ratio of the masses is a thousand.
TEST(BodyWorld, AHeavyBoxStandsOnALightOneAndALightOneOnAHeavyOne) {
  constexpr double kHeavy_kg = 10.0;
  constexpr double kLight_kg = 0.01;
  for (const bool is_heavy_above : {true, false}) {
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.5);
    bench.add_box(Vec3(0.02, 0.01, 0.02), is_heavy_above ? kLight_kg : kHeavy_kg,
                  {.translation = {0.0, 0.01, 0.0}}, 0.5);
    bench.add_box(Vec3(0.02, 0.01, 0.02), is_heavy_above ? kHeavy_kg : kLight_kg,
                  {.translation = {0.0, 0.03, 0.0}}, 0.5);
    bench.run(3.0);
    const Vec3 place = bench.body(1).motion().center_W;
    EXPECT_NEAR(place.y(), 0.03, 1e-3) << is_heavy_above;
    bench.run(2.0);
    EXPECT_LT((bench.body(1).motion().center_W - place).norm(), 1e-5) << is_heavy_above;
    EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-5) << is_heavy_above;
  }
}

TEST(BodyWorld, ABallBouncesToTheHeightOfItsRestitution) {
  for (const double restitution : {0.3, 0.7, 0.95}) {
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.0);
    bench.add_ball(0.01, 0.02, Vec3(0.0, 0.21, 0.0), {.friction = 0.0, .restitution = restitution});
    bench.run(std::sqrt(2.0 * 0.2 / kBodyGravity_m_per_s2) + 0.01);
    double top = 0.0;
    while (bench.body(0).motion().velocity_W.y() > 0.0) {
      top = bench.body(0).motion().center_W.y();
      bench.run(kBodyTick_s);
    }
    const double expected = 0.2 * restitution * restitution;
    EXPECT_NEAR(top - 0.01, expected, 0.02 * expected) << restitution;
  }
}

// Two balls that meet head-on exchange momentum as their masses say.
TEST(BodyWorld, BallsThatMeetKeepTheirMomentum) {
  BodyBench bench;
  bench.world().set_gravity(Vec3::Zero());
  bench.add_ball(0.01, 0.03, Vec3(-0.05, 0.0, 0.0), {.restitution = 0.5}, Vec3(0.8, 0.0, 0.0));
  bench.add_ball(0.01, 0.01, Vec3(0.05, 0.0, 0.0), {.restitution = 0.5}, Vec3(-0.4, 0.0, 0.0));
  bench.run(0.2);
  // v' = (momentum -+ e times the other mass times the approach) / total mass.
  const double momentum = 0.03 * 0.8 - 0.01 * 0.4;
  EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), (momentum - 0.5 * 0.01 * 1.2) / 0.04, 1e-9);
  EXPECT_NEAR(bench.body(1).motion().velocity_W.x(), (momentum + 0.5 * 0.03 * 1.2) / 0.04, 1e-9);
}

TEST(BodyWorld, NothingGoesThroughAPlaneHoweverFast) {
  for (const double speed : {1.0, 5.0, 20.0}) {
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.3);
    bench.add_ball(0.005, 0.01, Vec3(0.0, 0.1, 0.0), {.friction = 0.3}, Vec3(0.0, -speed, 0.0));
    double lowest = 1.0;
    for (int i = 0; i < 300; ++i) {
      bench.run(kBodyTick_s);
      lowest = std::min(lowest, bench.body(0).motion().center_W.y());
    }
    EXPECT_GT(lowest, 0.005 - 5e-4) << speed;
  }
}

}  // namespace
}  // namespace tactus::rendering
