// Bodies that sleep, against the same bodies awake.
#include "rendering/bodies/body_sleep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rendering/bodies/body_world.h"
#include "rendering/state_archive.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

constexpr double kSleepAfter_s = 0.2;
// The places of a sleeper and of one that is awake are this near, m; and after the sleeper has been
// woken they remain this near.
constexpr double kSamePlace_m = 1e-9;
constexpr double kSameAnswer_m = 1e-6;
constexpr std::size_t kPile = 3;

// A pile of boxes on a plane.
void add_pile(BodyBench& bench) {
  bench.add_plane(Vec3::UnitY(), 0.5);
  for (std::size_t i = 0; i < kPile; ++i) {
    const double height_m = 0.01 + 0.02 * static_cast<double>(i);
    bench.add_box(Vec3(0.02, 0.01, 0.02), 0.05, {.translation = Vec3(0.0, height_m, 0.0)}, 0.5);
  }
}

// Two worlds alike, of which one sleeps.
class SleepingBodies : public ::testing::Test {
 protected:
  void build(const std::function<void(BodyBench&)>& add) {
    add(sleeper_);
    add(waker_);
    sleeper_.world().set_sleep(kSleepAfter_s);
  }
  void run(double seconds) {
    sleeper_.run(seconds);
    waker_.run(seconds);
  }
  // Steps both worlds with a finger that pushes a body with a force.
  void push(std::uint32_t body, const Vec3& force_W, double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kBodyTick_s)); ++i) {
      for (BodyBench* const bench : {&sleeper_, &waker_}) {
        const Vec3 normal_W = -force_W.normalized();
        const FingerGrip grip{.body = body,
                              .point_W = bench->body(body).motion().center_W + 0.02 * normal_W,
                              .normal_W = normal_W,
                              .spring_force_W = -force_W};
        std::array<Vec3, 1> felt_W;
        bench->world().step(kBodyTick_s, {&grip, 1}, felt_W);
        EXPECT_LT((felt_W[0] + force_W).norm(), 1e-9);
      }
    }
  }
  [[nodiscard]] bool sleeps(std::size_t body) { return sleeper_.world().is_asleep(body); }
  // Returns the largest distance of a body's places in the two worlds, m.
  [[nodiscard]] double apart_m() const {
    double most = 0.0;
    for (std::size_t i = 0; i < sleeper_.bodies(); ++i) {
      most = std::max(
          most, (sleeper_.body(i).motion().center_W - waker_.body(i).motion().center_W).norm());
    }
    return most;
  }

  BodyBench sleeper_;
  BodyBench waker_;
};

TEST_F(SleepingBodies, LieWhereBodiesLieThatAreAwake) {
  build(add_pile);
  run(1.0);
  for (std::size_t i = 0; i < kPile; ++i) {
    EXPECT_TRUE(sleeps(i)) << i;
    EXPECT_FALSE(waker_.world().is_asleep(i));
  }
  run(5.0);
  EXPECT_LT(apart_m(), kSamePlace_m);
  EXPECT_EQ(sleeper_.world().point_count(), 0U) << "nothing is computed";
}

TEST_F(SleepingBodies, AnswerAFingerAsBodiesDoThatAreAwake) {
  build(add_pile);
  run(2.0);
  ASSERT_TRUE(sleeps(0));
  push(1, Vec3(0.9, 0.0, 0.0), 0.1);
  EXPECT_FALSE(sleeps(0)) << "the whole pile wakes";
  EXPECT_GT(waker_.body(1).motion().velocity_W.x(), 0.01);
  EXPECT_LT(apart_m(), kSameAnswer_m);
  run(0.3);
  EXPECT_LT(apart_m(), kSameAnswer_m);
  run(1.0);
  EXPECT_TRUE(sleeps(0)) << "and sleeps again";
}

TEST_F(SleepingBodies, DoNotFallAsleepUnderAFinger) {
  build(add_pile);
  push(kPile - 1, Vec3(0.0, -0.1, 0.0), 1.0);
  EXPECT_FALSE(sleeps(0));
  run(0.5);
  EXPECT_TRUE(sleeps(0));
}

TEST_F(SleepingBodies, WakeWhenABodyFallsOnThem) {
  build([](BodyBench& bench) {
    add_pile(bench);
    bench.add_ball(0.01, 0.02, Vec3(0.004, 3.0, 0.003), {.friction = 0.3, .restitution = 0.2});
  });
  run(0.7);
  ASSERT_TRUE(sleeps(0));
  EXPECT_FALSE(sleeps(kPile)) << "the ball flies";
  run(0.15);
  EXPECT_FALSE(sleeps(0));
  EXPECT_LT(apart_m(), kSameAnswer_m);
}

// A plate that comes from the side pushes, and one that leaves lets fall.
TEST_F(SleepingBodies, WakeWhenAnObstacleMovesAtThem) {
  PrimitiveHull plate;
  plate.make({.kind = PrimitiveKind::box, .dimensions_m = {0.05, 0.01, 0.05}});
  build([&](BodyBench& bench) {
    ASSERT_TRUE(bench.world().add_obstacle(
        {.hull = plate.hull(), .surface = {.friction = 0.5}, .X_WO = {}}));
    bench.add_box(Vec3(0.02, 0.01, 0.02), 0.05, {.translation = Vec3(0.0, 0.02, 0.0)}, 0.5);
  });
  run(1.0);
  ASSERT_TRUE(sleeps(0));
  for (int i = 0; i < 50; ++i) {
    const RigidPose pose{.translation = Vec3(0.0, -1e-3 * i, 0.0)};
    for (BodyBench* const bench : {&sleeper_, &waker_}) {
      bench->world().set_obstacle(0, pose, {.linear_W = Vec3(0.0, -1.0, 0.0)});
    }
    run(kBodyTick_s);
  }
  EXPECT_FALSE(sleeps(0));
  EXPECT_LT(waker_.body(0).motion().center_W.y(), 0.0195) << "it falls";
  EXPECT_LT(apart_m(), kSameAnswer_m);
}

TEST_F(SleepingBodies, WakeWhenTheGravityChanges) {
  build(add_pile);
  run(1.0);
  ASSERT_TRUE(sleeps(0));
  for (BodyBench* const bench : {&sleeper_, &waker_}) {
    bench->world().set_gravity(Vec3(0.0, 1.0, 0.0));
  }
  run(0.2);
  EXPECT_FALSE(sleeps(0));
  EXPECT_GT(sleeper_.body(0).motion().center_W.y(), 0.02);
  EXPECT_LT(apart_m(), kSameAnswer_m);
}

TEST_F(SleepingBodies, GoOnAlikeFromASavedState) {
  build(add_pile);
  waker_.world().set_sleep(kSleepAfter_s);
  sleeper_.run(1.0);
  waker_.run(0.013);
  ASSERT_TRUE(sleeps(0));
  std::vector<std::byte> room(std::size_t{1} << 20);
  StateArchive writer = StateArchive::writer(room);
  sleeper_.world().transfer(writer);
  ASSERT_TRUE(writer.good());
  StateArchive reader = StateArchive::reader(std::span(room).first(writer.size()));
  waker_.world().transfer(reader);
  ASSERT_TRUE(reader.good() && reader.at_end());
  EXPECT_TRUE(waker_.world().is_asleep(0));
  run(0.01);
  push(1, Vec3(0.9, 0.0, 0.0), 0.1);
  run(0.1);
  EXPECT_EQ(apart_m(), 0.0);
  EXPECT_EQ(sleeper_.body(2).motion().angular_momentum_W,
            waker_.body(2).motion().angular_momentum_W);
}

}  // namespace
}  // namespace tactus::rendering
