// Bodies of several convex parts, against bodies of one and the closed forms of mechanics.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "rendering/state_archive.h"
#include "tests/unit/rendering/bodies/compound_bench.h"

namespace tactus::rendering {
namespace {

constexpr double kDumbbellRadius_m = 0.01;
constexpr double kDumbbellArm_m = 0.03;
constexpr double kDumbbellMass_kg = 0.1;

// Two balls on the z axis, whose mass is within a share of the radius.
std::vector<Primitive> dumbbell() {
  return {ball_part(-kDumbbellArm_m * Vec3::UnitZ(), kDumbbellRadius_m),
          ball_part(kDumbbellArm_m * Vec3::UnitZ(), kDumbbellRadius_m)};
}
// Returns its mass, with this moment about its own axis over m r^2.
BodyMass mass_of_dumbbell(double share) {
  const double m = kDumbbellMass_kg;
  const double axial = share * m * kDumbbellRadius_m * kDumbbellRadius_m;
  const double across = m * kDumbbellArm_m * kDumbbellArm_m + 0.5 * axial;
  return {.mass_kg = m, .inertia_C = Vec3(across, across, axial).asDiagonal()};
}

TEST(CompoundBody, ADumbbellRestsOnItsTwoBalls) {
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  bench.add_compound(dumbbell(), mass_of_dumbbell(0.4), {.translation = Vec3(0.0, 0.0105, 0.0)},
                     {.friction = 0.5});
  bench.run(1.0);
  const BodyMotion& motion = bench.body(0).motion();
  EXPECT_EQ(bench.world().point_count(), 2U);
  EXPECT_NEAR(motion.center_W.y(), kDumbbellRadius_m, 2e-5);
  EXPECT_LT(motion.velocity_W.norm(), 1e-6);
  EXPECT_NEAR(motion.rotation_WO(1, 1), 1.0, 1e-9);
}

// a = g sin / (1 + I / (m r^2)).
TEST(CompoundBody, ADumbbellRollsAsItsInertiaAboutItsAxisSays) {
  const BodySlope slope{0.3};
  for (const double share : {0.2, 0.4, 0.9}) {
    BodyBench bench;
    bench.add_plane(slope.normal, 0.8);
    bench.add_compound(dumbbell(), mass_of_dumbbell(share),
                       {.translation = kDumbbellRadius_m * slope.normal}, {.friction = 0.8});
    bench.run(1.0);
    const double expected = kBodyGravity_m_per_s2 * std::sin(slope.angle) / (1.0 + share);
    EXPECT_NEAR(bench.body(0).motion().velocity_W.dot(slope.down), expected, 0.005 * expected)
        << share;
  }
}

// The impulse is (1 + e) v / (1 / m + 1 / M + d^2 / I) where a ball hits one end of the dumbbell.
TEST(CompoundBody, ABallThatHitsOneEndTurnsTheDumbbell) {
  constexpr double kSpeed = 0.5;
  constexpr double kBall_kg = 0.03;
  constexpr double kBounce = 0.6;
  BodyBench bench;
  bench.world().set_gravity(Vec3::Zero());
  const BodyMass mass = mass_of_dumbbell(0.4);
  bench.add_compound(dumbbell(), mass, {}, {.restitution = kBounce});
  bench.add_ball(kDumbbellRadius_m, kBall_kg, Vec3(-0.03, 0.0, kDumbbellArm_m),
                 {.restitution = kBounce}, Vec3(kSpeed, 0.0, 0.0));
  bench.run(0.05);
  const double impulse = (1.0 + kBounce) * kSpeed /
                         (1.0 / kBall_kg + 1.0 / mass.mass_kg +
                          kDumbbellArm_m * kDumbbellArm_m / mass.inertia_C(1, 1));
  EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), impulse / mass.mass_kg, 1e-3 * kSpeed);
  EXPECT_NEAR(bench.body(0).angular_velocity_W().y(),
              impulse * kDumbbellArm_m / mass.inertia_C(1, 1), 1e-2);
  EXPECT_NEAR(bench.body(1).motion().velocity_W.x(), kSpeed - impulse / kBall_kg, 1e-3 * kSpeed);
}

// A column with an arm to the right: it stands while the arm's moment about the column's right edge
// is less than the column's.
TEST(CompoundBody, AColumnWithAnArmTipsOverItsEdgeByStatics) {
  constexpr double kWidth = 0.02;
  constexpr double kHeight = 0.06;
  constexpr double kThick = 0.01;
  const double balance = std::sqrt(kWidth * kWidth * kHeight / kThick);
  for (const double factor : {0.98, 1.02}) {
    const double arm = factor * balance;
    const std::vector<Primitive> parts{
        box_part(Vec3(-0.5 * kWidth, 0.5 * kHeight, 0.0), Vec3(0.5 * kWidth, 0.5 * kHeight, 0.01)),
        box_part(Vec3(0.5 * arm, kHeight - 0.5 * kThick, 0.0),
                 Vec3(0.5 * arm, 0.5 * kThick, 0.01))};
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.8);
    bench.add_compound(parts, mass_of_boxes(parts, 1000.0), {}, {.friction = 0.8});
    bench.run(1.0);
    const Mat3& R = bench.body(0).motion().rotation_WO;
    if (factor < 1.0) {
      EXPECT_GT(R(1, 1), 1.0 - 1e-6) << "it stands";
      EXPECT_LT(bench.body(0).motion().velocity_W.norm(), 1e-5);
    } else {
      EXPECT_LT(R(1, 1), 0.8) << "it tips";
      EXPECT_GT(R(0, 1), 0.0) << "toward the arm";
    }
  }
}

// Two feet and a deck, with room below for an obstacle that the hull would meet.
std::vector<Primitive> bridge() {
  return {box_part(Vec3(-0.03, 0.01, 0.0), Vec3(0.005, 0.01, 0.02)),
          box_part(Vec3(0.03, 0.01, 0.0), Vec3(0.005, 0.01, 0.02)),
          box_part(Vec3(0.0, 0.025, 0.0), Vec3(0.035, 0.005, 0.02))};
}

TEST(CompoundBody, ABridgeStandsOverWhatItsHullWouldMeet) {
  PrimitiveHull block;
  block.make(box_part(Vec3(0.0, 0.009, 0.0), Vec3(0.02, 0.009, 0.02)));
  const Primitive ring{.kind = PrimitiveKind::torus,
                       .X_WO = {.translation = Vec3(0.0, 0.008, 0.0)},
                       .dimensions_m = {0.012, 0.006}};
  for (int kind = 0; kind < 4; ++kind) {
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.5);
    if (kind == 0) {
      ASSERT_TRUE(bench.world().add_obstacle({.hull = block.hull()}));
    } else if (kind == 1) {
      bench.add_mesh(testing::moved(testing::box(Vec3(0.04, 0.018, 0.04)), Vec3(0.0, 0.009, 0.0)),
                     0.5);
    } else if (kind == 2) {
      ASSERT_TRUE(bench.world().add_obstacle({.field = {.primitive = &ring}}));
    } else {
      bench.add_box(Vec3(0.02, 0.009, 0.01), 0.05, {.translation = Vec3(0.0, 0.009, 0.0)}, 0.5);
    }
    bench.add_compound(bridge(), mass_of_boxes(bridge(), 1000.0), {}, {.friction = 0.5});
    bench.run(0.5);
    const RigidBody& body = bench.world().bodies().back();
    EXPECT_NEAR(body.pose().translation.y(), 0.0, 2e-5) << kind;
    EXPECT_LT(body.motion().velocity_W.norm(), 1e-6) << kind;
  }
}

// The deck comes to rest on what is as high as the feet would be deep.
TEST(CompoundBody, ABridgeRestsWithItsDeckOnEveryKindOfObstacle) {
  constexpr double kTop_m = 0.03;
  PrimitiveHull block;
  block.make(box_part(Vec3(0.0, 0.5 * kTop_m, 0.0), Vec3(0.02, 0.5 * kTop_m, 0.02)));
  const Primitive ring{.kind = PrimitiveKind::torus,
                       .X_WO = {.translation = Vec3(0.0, kTop_m - 0.006, 0.0)},
                       .dimensions_m = {0.014, 0.006}};
  for (int kind = 0; kind < 3; ++kind) {
    BodyBench bench;
    bench.add_plane(Vec3::UnitY(), 0.5);
    if (kind == 0) {
      ASSERT_TRUE(bench.world().add_obstacle({.hull = block.hull(), .surface = {.friction = 0.5}}));
    } else if (kind == 1) {
      bench.add_mesh(
          testing::moved(testing::box(Vec3(0.04, kTop_m, 0.04)), Vec3(0.0, 0.5 * kTop_m, 0.0)),
          0.5);
    } else {
      ASSERT_TRUE(bench.world().add_obstacle(
          {.field = {.primitive = &ring}, .surface = {.friction = 0.5}}));
    }
    bench.add_compound(bridge(), mass_of_boxes(bridge(), 1000.0),
                       {.translation = Vec3(0.0, kTop_m - 0.019, 0.0)}, {.friction = 0.5});
    bench.run(1.0);
    const RigidBody& body = bench.world().bodies().back();
    EXPECT_NEAR(body.pose().translation.y(), kTop_m - 0.02, 5e-5) << kind;
    EXPECT_LT(body.motion().velocity_W.norm(), 1e-5) << kind;
  }
}

// Dumbbells that fall into a cup, and the cup on a plane.
void add_cup_of_dumbbells(BodyBench& bench) {
  const CupShape cup;
  bench.add_plane(Vec3::UnitY(), 0.5);
  bench.add_compound(cup.parts(), {.mass_kg = 0.2, .inertia_C = 2e-4 * Mat3::Identity()}, {},
                     {.friction = 0.5, .rolling_m = 1e-4});
  for (int i = 0; i < 3; ++i) {
    const RigidPose pose{.rotation = body_turned(Vec3(1.0, 0.3 * i, 0.2), 0.9),
                         .translation = Vec3(0.002 * i, 0.06 + 0.03 * i, 0.0)};
    bench.add_compound(
        {ball_part(Vec3(0.0, 0.0, -0.008), 0.006), ball_part(Vec3(0.0, 0.0, 0.008), 0.006)},
        {.mass_kg = 0.01, .inertia_C = 6e-7 * Mat3::Identity()}, pose,
        {.friction = 0.3, .restitution = 0.3});
  }
}

void expect_same_motion(const BodyBench& a, const BodyBench& b) {
  for (std::size_t i = 0; i < a.bodies(); ++i) {
    EXPECT_EQ(a.body(i).motion().center_W, b.body(i).motion().center_W) << i;
    EXPECT_EQ(a.body(i).motion().rotation_WO, b.body(i).motion().rotation_WO) << i;
    EXPECT_EQ(a.body(i).motion().velocity_W, b.body(i).motion().velocity_W) << i;
    EXPECT_EQ(a.body(i).motion().angular_momentum_W, b.body(i).motion().angular_momentum_W) << i;
  }
}

TEST(CompoundBody, GoesOnToTheBitAfterBeingRestored) {
  for (const double saved_after_s : {0.08, 0.2, 1.5}) {
    BodyBench saved;
    BodyBench restored;
    for (BodyBench* const bench : {&saved, &restored}) {
      add_cup_of_dumbbells(*bench);
      bench->world().set_sleep(0.3);
    }
    saved.run(saved_after_s);
    restored.run(0.05);
    std::vector<std::byte> room(std::size_t{1} << 20);
    StateArchive writer = StateArchive::writer(room);
    saved.world().transfer(writer);
    ASSERT_TRUE(writer.good());
    StateArchive reader = StateArchive::reader(std::span(room).first(writer.size()));
    restored.world().transfer(reader);
    ASSERT_TRUE(reader.good() && reader.at_end());
    saved.run(0.3);
    restored.run(0.3);
    expect_same_motion(saved, restored);
  }
}

TEST(CompoundBody, SleepsAndWakesWhenABallFallsOnIt) {
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), 0.5);
  bench.add_compound(bridge(), mass_of_boxes(bridge(), 1000.0), {}, {.friction = 0.5});
  bench.world().set_sleep(0.1);
  bench.add_ball(0.01, 0.02, Vec3(0.0, 2.0, 0.0), {.friction = 0.3, .restitution = 0.2});
  bench.run(0.5);
  EXPECT_TRUE(bench.world().is_asleep(0));
  bench.run(0.14);
  EXPECT_FALSE(bench.world().is_asleep(0));
  EXPECT_GT(bench.body(1).motion().center_W.y(), 0.039);
}

TEST(CompoundBody, HasNoMorePartsThanThereIsRoomFor) {
  BodyBench bench;
  PrimitiveHull box;
  box.make(box_part(Vec3::Zero(), Vec3::Constant(0.01)));
  const std::vector<ConvexHull> parts(kMaxPartsOfBody + 1, box.hull());
  const auto add = [&](std::size_t count) {
    return bench.world().add_body({.body = {}, .parts = std::span(parts).first(count)});
  };
  EXPECT_FALSE(add(0)) << "it has no hull either";
  EXPECT_FALSE(add(kMaxPartsOfBody + 1));
  for (std::size_t i = 0; i < kMaxBodyParts / kMaxPartsOfBody; ++i) {
    EXPECT_TRUE(add(kMaxPartsOfBody)) << i;
  }
  EXPECT_FALSE(add(1));
  EXPECT_EQ(bench.bodies(), kMaxBodyParts / kMaxPartsOfBody);
}

}  // namespace
}  // namespace tactus::rendering
