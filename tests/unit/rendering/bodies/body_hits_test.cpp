// Bodies that tumble, slide while they turn, hit and bounce, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rendering/bodies/body_world.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {
namespace {

const Vec3 kBrickHalf_m(0.03, 0.02, 0.01);
constexpr double kBrick_kg = 0.1;

Primitive brick_of(const Vec3& half) {
  return {.kind = PrimitiveKind::box, .dimensions_m = {half.x(), half.y(), half.z()}};
}

TEST(BodyHits, AFreeBodyOfAWorldKeepsItsMomentumAndItsEnergy) {
  BodyBench bench;
  bench.world().set_gravity(Vec3::Zero());
  const Vec3 turn(6.0, 2.0, 9.0);
  bench.add(brick_of(kBrickHalf_m), mass_of_box(kBrick_kg, kBrickHalf_m), {}, {.friction = 0.5},
            Vec3(0.1, 0.0, 0.0), turn);
  const Vec3 momentum = bench.body(0).motion().angular_momentum_W;
  const double energy = bench.body(0).kinetic_energy_J();
  double farthest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    bench.run(kBodyTick_s);
    const RigidBody& body = bench.body(0);
    EXPECT_LT((body.motion().angular_momentum_W - momentum).norm(), 1e-12 * momentum.norm());
    EXPECT_NEAR(body.kinetic_energy_J(), energy, 1e-10 * energy);
    farthest = std::max(farthest, (body.angular_velocity_W() - turn).norm());
  }
  EXPECT_GT(farthest, 1.0) << "it tumbles";
}

// The motion of a plate on its four corners, each of which carries a quarter of the weight and is
// slowed down against its own slip; integrated in small steps by the midpoint rule.
struct SlidingPlate {
  double half;
  double friction;
  // The velocity in the plane, m/s, the angular velocity, rad/s, and the angle.
  Eigen::Vector2d velocity;
  double turn;
  double angle = 0.0;

  void step(double step_s) {
    const SlidingPlate middle = moved(*this, 0.5 * step_s);
    *this = moved(middle, step_s);
  }

  // Returns this plate after a step with the accelerations that another one has.
  [[nodiscard]] SlidingPlate moved(const SlidingPlate& other, double step_s) const {
    Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
    double turning = 0.0;
    // The square of the radius of inertia is half^2 2 / 3.
    const double inertia = 2.0 / 3.0 * half * half;
    for (int i = 0; i < 4; ++i) {
      const double at = other.angle + (0.25 + 0.5 * i) * std::numbers::pi;
      const Eigen::Vector2d arm =
          std::sqrt(2.0) * half * Eigen::Vector2d(std::cos(at), std::sin(at));
      const Eigen::Vector2d slip = other.velocity + other.turn * Eigen::Vector2d(-arm.y(), arm.x());
      const Eigen::Vector2d force = -0.25 * friction * kBodyGravity_m_per_s2 / slip.norm() * slip;
      acceleration += force;
      turning += (arm.x() * force.y() - arm.y() * force.x()) / inertia;
    }
    SlidingPlate next = *this;
    next.velocity += step_s * acceleration;
    next.turn += step_s * turning;
    next.angle += step_s * other.turn;
    return next;
  }
};

// Seen along y the plane's axes are z and x. The plate is low, so that its corners carry nearly the
// same; statics leaves open how four corners share a weight.
TEST(BodyHits, ABoxThatTurnsAsItSlidesIsSlowedDownAgainstTheSlipOfItsCorners) {
  constexpr double kFriction = 0.3;
  constexpr double kSeconds = 0.2;
  const Vec3 half(0.03, 5e-4, 0.03);
  BodyBench bench;
  bench.add_plane(Vec3::UnitY(), kFriction);
  bench.add(brick_of(half), mass_of_box(kBrick_kg, half), {.translation = {0.0, half.y(), 0.0}},
            {.friction = kFriction}, Vec3(1.0, 0.0, 0.0), Vec3(0.0, 20.0, 0.0));
  SlidingPlate plate{.half = half.x(), .friction = kFriction, .velocity = {0.0, 1.0}, .turn = 20.0};
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    plate.step(kSeconds / kSteps);
  }
  bench.run(kSeconds);
  const RigidBody& box = bench.body(0);
  EXPECT_NEAR(box.motion().velocity_W.x(), plate.velocity.y(), 0.01);
  EXPECT_NEAR(box.motion().velocity_W.z(), plate.velocity.x(), 0.01);
  EXPECT_NEAR(box.angular_velocity_W().y(), plate.turn, 0.01 * 20.0);
  const Vec3 side = body_turned(Vec3::UnitY(), plate.angle).col(0);
  EXPECT_LT((box.motion().rotation_WO.col(0) - side).norm(), 0.02 * plate.angle);
}

// An edge stops when it meets the ground, and the box turns about it and about nothing else.
TEST(BodyHits, ABoxThatFallsOnAnEdgeTurnsAboutThatEdgeAlone) {
  constexpr double kLean_rad = 0.4;
  constexpr double kSpeed_m_per_s = 1.0;
  const Mat3 rotation = body_turned(Vec3::UnitZ(), kLean_rad);
  const Vec3 edge = rotation * Vec3(-kBrickHalf_m.x(), -kBrickHalf_m.y(), 0.0);
  const BodyMass mass = mass_of_box(kBrick_kg, kBrickHalf_m);
  BodyBench bench;
  bench.world().set_gravity(Vec3::Zero());
  bench.add_plane(Vec3::UnitY(), 0.0);
  bench.add(brick_of(kBrickHalf_m), mass,
            {.rotation = rotation, .translation = {0.0, 2.3e-3 - edge.y(), 0.0}}, {},
            Vec3(0.0, -kSpeed_m_per_s, 0.0));
  bench.run(5.0 * kBodyTick_s);
  const double inertia = mass.inertia_C(2, 2);
  const double impulse = kSpeed_m_per_s / (1.0 / kBrick_kg + edge.x() * edge.x() / inertia);
  const double turn = edge.x() * impulse / inertia;
  const Vec3 found = bench.body(0).angular_velocity_W();
  EXPECT_NEAR(found.z(), turn, 0.01 * std::abs(turn));
  EXPECT_LT(found.head<2>().norm(), 1e-3 * std::abs(turn));
  EXPECT_NEAR(bench.body(0).motion().velocity_W.y(), impulse / kBrick_kg - kSpeed_m_per_s, 0.01);
}

// Two faces part everywhere with the same speed, so that both boxes turn alike: the impulse meets
// the faces at the height s I / (I + I') over the centre of A, where B's centre has the height s.
TEST(BodyHits, FacesThatMeetOffTheirCentresBounceEverywhereAlike) {
  constexpr double kOffset_m = 0.015;
  constexpr double kOther_kg = 0.05;
  constexpr double kApproach_m_per_s = 1.5;
  for (const double restitution : {0.2, 0.5, 0.9}) {
    BodyBench bench;
    bench.world().set_gravity(Vec3::Zero());
    const BodyMass a = mass_of_box(kBrick_kg, kBrickHalf_m);
    const BodyMass b = mass_of_box(kOther_kg, kBrickHalf_m);
    bench.add(brick_of(kBrickHalf_m), a, {}, {.restitution = restitution}, Vec3(1.0, 0.0, 0.0));
    bench.add(brick_of(kBrickHalf_m), b, {.translation = {0.0623, kOffset_m, 0.0}}, {},
              Vec3(1.0 - kApproach_m_per_s, 0.0, 0.0));
    bench.run(5.0 * kBodyTick_s);
    const double inertia = a.inertia_C(2, 2);
    const double height = kOffset_m * inertia / (inertia + b.inertia_C(2, 2));
    const double impulse = (1.0 + restitution) * kApproach_m_per_s /
                           (1.0 / kBrick_kg + 1.0 / kOther_kg + kOffset_m * height / inertia);
    const double turn = impulse * height / inertia;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 found = bench.body(i).angular_velocity_W();
      EXPECT_NEAR(found.z(), turn, 0.01 * turn) << restitution << " " << i;
      EXPECT_LT(found.head<2>().norm(), 1e-3 * turn) << restitution << " " << i;
    }
    EXPECT_NEAR(bench.body(0).motion().velocity_W.x(), 1.0 - impulse / kBrick_kg, 2e-3);
  }
}

}  // namespace
}  // namespace tactus::rendering
