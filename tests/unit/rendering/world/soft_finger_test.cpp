// Soft fingers: friction about the contact normal, against the closed forms of Hertz's contact.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include "rendering/world/world.h"

namespace tactus::rendering {
namespace {

constexpr double kSoftTick_s = 1e-3;
constexpr double kPad_N_per_m = 3000.0;
constexpr double kPadFriction = 1.0;
constexpr double kPadRadius_m = 0.008;
// The depth by which the fingers press, m, and their force, N.
constexpr double kPress_m = 0.002;
constexpr double kPress_N = kPad_N_per_m * kPress_m;
constexpr double kBarMass_kg = 0.05;
const Vec3 kBarHalf_m(0.01, 0.005, 0.05);
// The arm from the fingers to the bar's middle, m.
constexpr double kBarArm_m = 0.04;

// Returns the modulus with which one finger's torque about its normal is at most `torque_Nm`.
double modulus_of(double torque_Nm) {
  const double radius_m = torque_Nm / (3.0 * std::numbers::pi / 16.0 * kPadFriction * kPress_N);
  return 0.75 * kPress_N * kPadRadius_m / (radius_m * radius_m * radius_m);
}

// Two fingers hold a bar that lies along z, on its sides at x.
class SoftFingers : public ::testing::Test {
 protected:
  // Starts with the bar's middle at -`arm_m` along z from the line through the fingers.
  void start(World& world, double modulus_Pa, const Vec3& gravity_W, double arm_m,
             const Vec3& angular_velocity_W = Vec3::Zero()) {
    const Vec3 square = kBarHalf_m.cwiseProduct(kBarHalf_m);
    const Vec3 moments = kBarMass_kg / 3.0 * (Vec3::Constant(square.sum()) - square);
    body_.mass = {.mass_kg = kBarMass_kg, .inertia_C = moments.asDiagonal()};
    body_.angular_velocity_O = angular_velocity_W;
    body_.mass.center_O = Vec3(0.0, 0.0, -arm_m);
    bar_.surface = SurfaceKind::primitive;
    bar_.primitive = {.kind = PrimitiveKind::box,
                      .X_WO = {.translation = Vec3(0.0, 0.0, -arm_m)},
                      .dimensions_m = {kBarHalf_m.x(), kBarHalf_m.y(), kBarHalf_m.z()}};
    bar_.material.stiffness_N_per_m = kPad_N_per_m;
    bar_.material.damping_Ns_per_m = 2.0;
    bar_.material.friction.coulomb = kPadFriction;
    bar_.material.friction.static_level = kPadFriction;
    bar_.moves = true;
    bar_.body = 0;
    ASSERT_TRUE(world.set_scene({&bar_, 1}, {.tool_radius_m = kPadRadius_m,
                                             .tool_count = 2,
                                             .bodies = {&body_, 1},
                                             .gravity_W = gravity_W,
                                             .soft_finger_modulus_Pa = modulus_Pa}));
    ASSERT_TRUE(world.set_tick(kSoftTick_s));
    // Both tools begin outside and come in.
    run(world, -1e-4, 1);
  }
  void run(World& world, double press_m, int ticks) {
    const double out_m = kBarHalf_m.x() + kPadRadius_m - press_m;
    const std::array tools{ToolState{.p_W = Vec3(-out_m, 0.0, 0.0)},
                           ToolState{.p_W = Vec3(out_m, 0.0, 0.0)}};
    for (int i = 0; i < ticks; ++i) {
      world.touch(tools, touches_);
    }
  }
  // Returns how far the bar's end hangs: the lean of its axis, rad.
  static double lean(const World& world) {
    const Vec3 axis_W = world.body(0)->motion().rotation_WO.col(2);
    return std::abs(std::atan2(axis_W.y(), axis_W.z()));
  }

  ObjectBody body_;
  Object bar_;
  std::unique_ptr<WorldOf<2>> world_ = std::make_unique<WorldOf<2>>();
  std::array<Touch, 2> touches_;
};

TEST_F(SoftFingers, HoldABarByItsEndUpToTheTorqueOfBothAndNotBeyond) {
  const double moment_Nm = kBarMass_kg * kStandardGravity_m_per_s2 * kBarArm_m;
  for (const double share : {0.99, 1.01}) {
    start(*world_, modulus_of(0.5 * share * moment_Nm), standard_gravity_W(), kBarArm_m);
    run(*world_, 2.0 * kPress_m, 500);
    const double held = lean(*world_);
    run(*world_, kPress_m, 500);
    const double later = lean(*world_);
    if (share > 1.0) {
      EXPECT_LT(held, 0.05);
      EXPECT_LT(later - held, 1e-3);
      run(*world_, kPress_m, 2000);
      EXPECT_LT(std::abs(lean(*world_) - later), 1e-6) << "it does not creep";
      EXPECT_NEAR(std::abs(touches_[0].force_W.x()), kPress_N, 2e-3) << "a margin of half a um";
    } else {
      EXPECT_GT(later - held, 0.03);
    }
  }
}

// Fingers that touch in a point let the bar swing freely.
TEST_F(SoftFingers, OfNoModulusTouchInAPoint) {
  start(*world_, 0.0, standard_gravity_W(), kBarArm_m);
  run(*world_, kPress_m, 100);
  EXPECT_GT(lean(*world_), 0.5);
}

// The torques of both slow it down: it stops after I w / (2 M), and has then turned by w / 2 of it.
TEST_F(SoftFingers, StopABarThatTurnsAboutTheLineThroughThem) {
  constexpr double kTurn_rad_per_s = 20.0;
  constexpr double kTorque_Nm = 0.004;
  start(*world_, modulus_of(kTorque_Nm), Vec3::Zero(), 0.0, kTurn_rad_per_s * Vec3::UnitX());
  const double inertia = body_.mass.inertia_C(0, 0);
  run(*world_, kPress_m, 5);
  const double begun = lean(*world_);
  const double speed = world_->body(0)->angular_velocity_W().x();
  const double stop_s = inertia * speed / (2.0 * kTorque_Nm);
  const int ticks = static_cast<int>(std::lround(0.5 * stop_s / kSoftTick_s));
  run(*world_, kPress_m, ticks);
  EXPECT_NEAR(world_->body(0)->angular_velocity_W().x(),
              speed - 2.0 * kTorque_Nm * ticks * kSoftTick_s / inertia, 0.005 * speed);
  run(*world_, kPress_m, ticks + 10);
  EXPECT_LT(world_->body(0)->angular_velocity_W().norm(), 1e-9);
  EXPECT_NEAR(lean(*world_) - begun, 0.5 * speed * stop_s, 0.01 * 0.5 * speed * stop_s);
}

TEST_F(SoftFingers, GoOnAlikeFromASavedState) {
  const double moment_Nm = kBarMass_kg * kStandardGravity_m_per_s2 * kBarArm_m;
  auto other = std::make_unique<WorldOf<2>>();
  start(*other, modulus_of(0.6 * moment_Nm), standard_gravity_W(), kBarArm_m);
  start(*world_, modulus_of(0.6 * moment_Nm), standard_gravity_W(), kBarArm_m);
  run(*world_, kPress_m, 40);
  std::vector<std::byte> room(std::size_t{1} << 22);
  StateArchive writer = StateArchive::writer(room);
  world_->transfer(writer);
  ASSERT_TRUE(writer.good());
  StateArchive reader = StateArchive::reader(std::span(room).first(writer.size()));
  other->transfer(reader);
  ASSERT_TRUE(reader.good());
  for (int i = 0; i < 200; ++i) {
    run(*world_, kPress_m, 1);
    const Vec3 force_W = touches_[0].force_W;
    run(*other, kPress_m, 1);
    ASSERT_EQ(touches_[0].force_W, force_W) << i;
    ASSERT_EQ(other->body(0)->motion().angular_momentum_W,
              world_->body(0)->motion().angular_momentum_W);
  }
}

}  // namespace
}  // namespace tactus::rendering
