// Rolling and spinning friction against the closed forms of mechanics. A solid ball of mass m and
// radius r that rolls has m v' = -F and (2/5) m r^2 w' = F r - c N, with v = r w and N = m g: then
// v' = -(5/7) g c / r.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rendering/bodies/body_world.h"
#include "rendering/state_archive.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

constexpr double kBallRadius_m = 0.02;
constexpr double kBallMass_kg = 0.05;
constexpr double kRolling_m = 1e-3;
constexpr double kSpinning_m = 5e-4;
constexpr ContactSurface kFelt{.friction = 0.6, .rolling_m = kRolling_m, .spinning_m = kSpinning_m};
const double kRollingLoss_m_per_s2 = 5.0 / 7.0 * kBodyGravity_m_per_s2 * kRolling_m / kBallRadius_m;

// Adds a ball on a plane through the origin.
void add_felt_ball(BodyBench& bench, const Vec3& normal, const Vec3& velocity = Vec3::Zero(),
                   const Vec3& angular_velocity = Vec3::Zero()) {
  bench.add_ball(kBallRadius_m, kBallMass_kg, kBallRadius_m * normal, kFelt, velocity,
                 angular_velocity);
}

TEST(TurnFriction, SlowsARollingBallByFiveSevenths) {
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.6);
  constexpr double kSpeed = 0.2;
  add_felt_ball(bench, Vec3::UnitY(), Vec3(kSpeed, 0.0, 0.0),
                Vec3(0.0, 0.0, -kSpeed / kBallRadius_m));
  bench.run(0.3);
  const double left = kSpeed - 0.3 * kRollingLoss_m_per_s2;
  EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), left, 0.002 * kSpeed);
  EXPECT_NEAR(-bench.body(0).angular_velocity_W().z() * kBallRadius_m, left, 0.002 * kSpeed);
  // It stops after v^2 / (2 a), and stays there.
  bench.run(left / kRollingLoss_m_per_s2 + 0.02);
  const Vec3 stopped = bench.body(0).motion().center_W;
  const double expected = kSpeed * kSpeed / (2.0 * kRollingLoss_m_per_s2);
  EXPECT_NEAR(stopped.x(), expected, 0.005 * expected);
  bench.run(2.0);
  EXPECT_LT((bench.body(0).motion().center_W - stopped).norm(), 1e-6);
  EXPECT_LT(bench.body(0).angular_velocity_W().norm(), 1e-9);
}

// The torque c N holds the ball where m g r sin <= c m g cos, so up to the slope c / r.
TEST(TurnFriction, HoldsABallOnASlopeUpToItsLengthOverTheRadius) {
  for (const double share : {0.98, 1.02, 3.0}) {
    const BodySlope slope{std::atan(share * kRolling_m / kBallRadius_m)};
    BodyBench bench;
    bench.add_plane(slope.normal, 0.6);
    add_felt_ball(bench, slope.normal);
    bench.run(0.2);
    const Vec3 start = bench.body(0).motion().center_W;
    const double before = bench.body(0).motion().velocity_W.dot(slope.down);
    bench.run(1.0);
    if (share < 1.0) {
      EXPECT_LT((bench.body(0).motion().center_W - start).norm(), 1e-6);
      continue;
    }
    const double gained = bench.body(0).motion().velocity_W.dot(slope.down) - before;
    const double expected =
        5.0 / 7.0 * kBodyGravity_m_per_s2 *
        (std::sin(slope.angle) - kRolling_m / kBallRadius_m * std::cos(slope.angle));
    EXPECT_NEAR(gained, expected, 0.02 * expected) << share;
  }
}

// The torque c N stops the ball after I w / (c N).
TEST(TurnFriction, StopsABallThatSpinsAboutTheNormal) {
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.6);
  constexpr double kTurn_rad_per_s = 40.0;
  add_felt_ball(bench, Vec3::UnitY(), Vec3::Zero(), Vec3(0.0, kTurn_rad_per_s, 0.0));
  const double inertia = 0.4 * kBallMass_kg * kBallRadius_m * kBallRadius_m;
  const double stop_s =
      inertia * kTurn_rad_per_s / (kSpinning_m * kBallMass_kg * kBodyGravity_m_per_s2);
  bench.run(0.5 * stop_s);
  EXPECT_NEAR(bench.body(0).angular_velocity_W().y(), 0.5 * kTurn_rad_per_s,
              0.01 * kTurn_rad_per_s);
  bench.run(0.49 * stop_s);
  EXPECT_GT(bench.body(0).angular_velocity_W().y(), 0.0);
  bench.run(0.03 * stop_s);
  EXPECT_LT(bench.body(0).angular_velocity_W().norm(), 1e-9);
}

// Action equals reaction: the torque that slows the ball down turns the board below it, which
// nothing else holds.
TEST(TurnFriction, KeepsTheAngularMomentumOfABallOnABoard) {
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.0);
  bench.add_box(Vec3(0.1, 0.01, 0.1), 0.5, {.translation = Vec3(0.0, 0.01, 0.0)}, 0.6);
  bench.add_ball(kBallRadius_m, kBallMass_kg, Vec3(0.0, 0.02 + kBallRadius_m, 0.0),
                 {.friction = 0.6, .spinning_m = 0.01}, Vec3::Zero(), Vec3(0.0, 40.0, 0.0));
  const double momentum = bench.body(1).motion().angular_momentum_W.y();
  bench.run(0.2);
  const double sum =
      bench.body(0).motion().angular_momentum_W.y() + bench.body(1).motion().angular_momentum_W.y();
  EXPECT_GT(bench.body(0).motion().angular_momentum_W.y(), 0.1 * momentum);
  EXPECT_NEAR(sum, momentum, 1e-6 * momentum);
}

TEST(TurnFriction, GoesOnAlikeFromASavedState) {
  BodyBench bench;
  BodyBench other;
  for (BodyBench* const one : {&bench, &other}) {
    one->add_plane(BodySlope{0.03}.normal, 0.6);
    add_felt_ball(*one, BodySlope{0.03}.normal);
  }
  bench.run(0.05);
  std::vector<std::byte> room(std::size_t{1} << 20);
  StateArchive writer = StateArchive::writer(room);
  bench.world().transfer(writer);
  ASSERT_TRUE(writer.good());
  StateArchive reader = StateArchive::reader(std::span(room).first(writer.size()));
  other.world().transfer(reader);
  ASSERT_TRUE(reader.good() && reader.at_end());
  for (int i = 0; i < 100; ++i) {
    bench.run(kBodyTick_s);
    other.run(kBodyTick_s);
    ASSERT_EQ(bench.body(0).motion().center_W, other.body(0).motion().center_W) << i;
    ASSERT_EQ(bench.body(0).motion().angular_momentum_W, other.body(0).motion().angular_momentum_W);
  }
}

}  // namespace
}  // namespace tactus::rendering
