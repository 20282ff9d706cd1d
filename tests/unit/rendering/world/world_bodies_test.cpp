// Fingers that hold bodies in a world, against the laws of mechanics.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include "rendering/friction/registered_models.h"
#include "rendering/world/world.h"

namespace tactus::rendering {
namespace {

constexpr double kGraspTick_s = 1e-3;
constexpr double kRubber_N_per_m = 1000.0;

Material rubber(double friction, double stiffness, double damping) {
  Material material;
  material.stiffness_N_per_m = stiffness;
  material.damping_Ns_per_m = damping;
  material.friction.coulomb = friction;
  material.friction.static_level = friction;
  return material;
}

// A cube of 4 cm in the world, between two fingers along x.
class Grasp : public ::testing::Test {
 protected:
  static constexpr double kHalf_m = 0.02;

  void start(double mass_kg, double friction, double stiffness = kRubber_N_per_m,
             double damping = 2.0, const Vec3& between_W = Vec3::Zero()) {
    const double moment = 2.0 / 3.0 * mass_kg * kHalf_m * kHalf_m;
    body_.mass = {.mass_kg = mass_kg, .inertia_C = moment * Mat3::Identity()};
    cube_.surface = SurfaceKind::primitive;
    cube_.primitive = {
        .kind = PrimitiveKind::box, .X_WO = {}, .dimensions_m = {kHalf_m, kHalf_m, kHalf_m}};
    cube_.material = rubber(friction, stiffness, damping);
    cube_.material.friction.kind = model_->kind;
    cube_.material.friction.stiffness_N_per_m = model_->has_bristles ? stiffness : 0.0;
    cube_.moves = true;
    cube_.body = 0;
    ASSERT_TRUE(world_->set_scene({&cube_, 1}, {.tool_count = 2, .bodies = {&body_, 1}}));
    ASSERT_TRUE(world_->set_tick(kGraspTick_s));
    // Both tools begin outside and come in.
    set_fingers(-1e-4, between_W);
    for (int i = 0; i < 3; ++i) {
      tick();
    }
  }

  // Gives the cube another friction model with the same levels; its bristles are as stiff as its
  // contact. Call before start().
  void choose_model(const FrictionModelTraits& model) { model_ = &model; }

  // Puts both fingers `press_m` below the faces of a cube at `center_W`.
  void set_fingers(double press_m, const Vec3& center_W, const Vec3& v_W = Vec3::Zero()) {
    tools_[0] = {.p_W = center_W - (kHalf_m - press_m) * Vec3::UnitX(), .v_W = v_W};
    tools_[1] = {.p_W = center_W + (kHalf_m - press_m) * Vec3::UnitX(), .v_W = v_W};
  }
  void hold_still(double press_m, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      set_fingers(press_m, Vec3::Zero());
      tick();
    }
  }
  void tick() { world_->touch(tools_, touches_); }
  [[nodiscard]] const RigidBody& cube() const { return *world_->body(0); }

  const FrictionModelTraits* model_ = kFrictionModels.data();
  ObjectBody body_;
  Object cube_;
  std::unique_ptr<WorldOf<2>> world_ = std::make_unique<WorldOf<2>>();
  std::array<ToolState, 2> tools_;
  std::array<Touch, 2> touches_;
};

// With every friction model: a model with bristles yields by their stretch before it holds.
TEST_F(Grasp, HoldsWhereFrictionCarriesTheWeightAndNotBelow) {
  constexpr double kFriction = 0.5;
  for (const FrictionModelTraits& model : kFrictionModels) {
    choose_model(model);
    for (const double share : {0.99, 1.01}) {
      SCOPED_TRACE(::testing::Message() << model.name << " " << share);
      // 2 mu F = share m g.
      const double mass_kg = 0.1;
      const double press_m =
          share * mass_kg * kStandardGravity_m_per_s2 / (2.0 * kFriction * kRubber_N_per_m);
      start(mass_kg, kFriction);
      hold_still(2.0 * press_m, 1000);
      const double held_y = cube().motion().center_W.y();
      hold_still(press_m, 1000);
      const double fallen_m = held_y - cube().motion().center_W.y();
      if (share > 1.0) {
        EXPECT_LT(fallen_m, 1e-4);
        // On bristles without damping the cube rings.
        const double ringing = model.has_bristles ? 10.0 : 1.0;
        EXPECT_LT(cube().motion().velocity_W.norm(), ringing * 1e-6);
        const Vec3 sum = touches_[0].force_W + touches_[1].force_W;
        EXPECT_LT((sum - Vec3(0.0, -mass_kg * kStandardGravity_m_per_s2, 0.0)).norm(),
                  ringing * 1e-4)
            << "they carry it";
      } else {
        EXPECT_GT(fallen_m, 0.03);
      }
    }
  }
}

// What the hands give to a body is what it gains: action equals reaction.
TEST_F(Grasp, GivesTheBodyWhatTheHandsFeel) {
  start(0.02, 0.8);
  for (int i = 0; i < 2000; ++i) {
    const double t = i * kGraspTick_s;
    const Vec3 center(0.01 * std::sin(9.0 * t), 0.02 * (1.0 - std::cos(7.0 * t)),
                      0.005 * std::sin(13.0 * t));
    const Vec3 v(0.09 * std::cos(9.0 * t), 0.14 * std::sin(7.0 * t), 0.065 * std::cos(13.0 * t));
    set_fingers(0.002, center, v);
    const Vec3 before = cube().motion().velocity_W;
    tick();
    const Vec3 gained = 0.02 * (cube().motion().velocity_W - before);
    const Vec3 given = kGraspTick_s * (Vec3(0.0, -0.02 * kStandardGravity_m_per_s2, 0.0) -
                                       touches_[0].force_W - touches_[1].force_W);
    ASSERT_LT((gained - given).norm(), 1e-12) << i;
  }
  EXPECT_GT(cube().motion().center_W.y(), -0.01) << "it is still held";
}

// Explicit springs are unstable below the sum of K T^2 / 4, which is 1.5 g here.
TEST_F(Grasp, HoldsTheLightestAndTheHeaviestWithoutVibration) {
  for (const double mass_kg : {5e-5, 1e-3, 0.1, 10.0}) {
    // The heaviest would swing on its springs for seconds with the damping of the lightest.
    start(mass_kg, 2.0, 3000.0, mass_kg > 1.0 ? 150.0 : 2.0);
    const double press_m = std::max(0.002, mass_kg * kStandardGravity_m_per_s2 / (2.0 * 3000.0));
    double least = 1e9;
    double most = -1e9;
    for (int i = 0; i < 2000; ++i) {
      set_fingers(press_m, Vec3::Zero());
      tick();
      if (i >= 1500) {
        least = std::min({least, touches_[0].force_W.x(), -touches_[1].force_W.x()});
        most = std::max({most, touches_[0].force_W.x(), -touches_[1].force_W.x()});
      }
    }
    EXPECT_LT(most - least, 1e-3) << mass_kg << " kg";
    EXPECT_NEAR(-most, 3000.0 * press_m, 0.05 * 3000.0 * press_m) << mass_kg << " kg";
    EXPECT_LT(cube().motion().velocity_W.norm(), 1e-5) << mass_kg << " kg";
  }
}

// A cube that hangs from two fingers above its middle swings as a physical pendulum.
TEST_F(Grasp, SwingsAboutTheFingersAsAPendulum) {
  constexpr double kArm_m = 0.012;
  constexpr double kMass_kg = 0.1;
  body_.angular_velocity_O = Vec3(1.0, 0.0, 0.0);
  start(kMass_kg, 2.0, 3000.0, 2.0, Vec3(0.0, kArm_m, 0.0));
  std::vector<double> zeros_s;
  double before = 0.0;
  for (int i = 0; i < 4000; ++i) {
    set_fingers(0.003, Vec3(0.0, kArm_m, 0.0));
    tick();
    const double lean = cube().motion().rotation_WO(2, 1);
    if (i > 1000 && lean > 0.0 && before <= 0.0) {
      zeros_s.push_back((i - lean / (lean - before)) * kGraspTick_s);
    }
    before = lean;
  }
  ASSERT_GE(zeros_s.size(), 5U);
  const double period_s =
      (zeros_s.back() - zeros_s.front()) / static_cast<double>(zeros_s.size() - 1);
  const double inertia = cube().mass().inertia_C(0, 0) + kMass_kg * kArm_m * kArm_m;
  const double expected_s =
      2.0 * std::numbers::pi * std::sqrt(inertia / (kMass_kg * kStandardGravity_m_per_s2 * kArm_m));
  EXPECT_NEAR(period_s, expected_s, 0.01 * expected_s);
}

// Every pair of cubes at one place is a contact. A tool far away has the flag, too: it is told what
// becomes of the world.
TEST(BodyContacts, BeyondTheCapacityAreToldToEveryTool) {
  for (const std::uint32_t count : {16U, 17U}) {
    const std::size_t contacts = std::size_t{count} * (count - 1) / 2;
    const std::vector<ObjectBody> bodies(
        count, {.mass = {.mass_kg = 0.1, .inertia_C = 1e-5 * Mat3::Identity()}});
    std::vector<Object> cubes(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      cubes[i].surface = SurfaceKind::primitive;
      cubes[i].primitive = {
          .kind = PrimitiveKind::box, .X_WO = {}, .dimensions_m = {0.01, 0.01, 0.01}};
      cubes[i].moves = true;
      cubes[i].body = static_cast<std::uint8_t>(i);
    }
    const auto world = std::make_unique<WorldOf<2>>();
    ASSERT_TRUE(world->set_scene(cubes, {.tool_count = 2, .bodies = bodies}));
    std::array<ToolState, 2> tools;
    tools[0].p_W = Vec3(0.5, 0.0, 0.0);
    tools[1].p_W = Vec3(0.0, 0.5, 0.0);
    std::array<Touch, 2> touches;
    world->touch(tools, touches);
    const std::uint32_t expected =
        contacts > kMaxBodyContacts ? kTouchBodyContactsOverflow : kTouchClean;
    EXPECT_EQ(touches[0].flags, expected) << contacts;
    EXPECT_EQ(touches[1].flags, expected) << contacts;
  }
}

}  // namespace
}  // namespace tactus::rendering
