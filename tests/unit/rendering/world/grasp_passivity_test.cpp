// The world gives hands no more than hands and gravity have put in, over random graspings of a
// body.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>

#include <Eigen/Dense>

#include "rendering/friction/registered_models.h"
#include "rendering/world/world.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::share_of;

constexpr double kPassiveTick_s = 1e-3;
constexpr std::size_t kTicksOfAGrasping = 200;
// More than this the world never makes in a tick, J.
constexpr double kMostMade_J = 1e-9;

// A hand's motion: a sine of its own along each axis.
struct HandMotion {
  Vec3 amplitude_m;
  Vec3 rate_rad_per_s;
  Vec3 phase_rad;

  [[nodiscard]] Vec3 offset_m(double t_s) const {
    return {amplitude_m.x() * std::sin(rate_rad_per_s.x() * t_s + phase_rad.x()),
            amplitude_m.y() * std::sin(rate_rad_per_s.y() * t_s + phase_rad.y()),
            amplitude_m.z() * std::sin(rate_rad_per_s.z() * t_s + phase_rad.z())};
  }
};

// A cube between two fingers along x, points or balls, all of it random, also the friction model.
class RandomGrasping {
 public:
  explicit RandomGrasping(std::mt19937_64& random)
      : random_(&random),
        half_m_(between(0.005, 0.03)),
        press_m_(between(0.0, 0.004)),
        radius_m_(unit() > 0.0 ? 0.0 : between(0.001, 0.01)) {
    const double mass_kg = between(0.01, 0.5);
    body_.mass = {.mass_kg = mass_kg,
                  .inertia_C = 2.0 / 3.0 * mass_kg * half_m_ * half_m_ * Mat3::Identity()};
    body_.velocity_W = 0.05 * direction();
    body_.angular_velocity_O = direction();
    cube_.surface = SurfaceKind::primitive;
    cube_.primitive = {
        .kind = PrimitiveKind::box, .X_WO = {}, .dimensions_m = {half_m_, half_m_, half_m_}};
    cube_.moves = true;
    cube_.body = 0;
    Material& material = cube_.material;
    material.stiffness_N_per_m = between(100.0, 3000.0);
    material.damping_Ns_per_m = unit() > 0.0 ? 0.0 : between(0.0, 3.0);
    material.friction.coulomb = between(0.1, 1.5);
    material.friction.static_level = material.friction.coulomb;
    const FrictionModelTraits& model =
        kFrictionModels[std::uniform_int_distribution<std::size_t>(0, kFrictionKinds - 1)(random)];
    material.friction.kind = model.kind;
    material.friction.stiffness_N_per_m =
        model.has_bristles || unit() > 0.0 ? between(0.3, 1.0) * material.stiffness_N_per_m : 0.0;
    both_ = motion(0.03);
    for (HandMotion& hand : hands_) {
      hand = motion(unit() > 0.0 ? 0.0005 : 0.01);
    }
  }

  // Returns the most that a tick has made, J.
  double most_made_J() {
    EXPECT_TRUE(world_->set_scene(
        {&cube_, 1}, {.tool_radius_m = radius_m_, .tool_count = 2, .bodies = {&body_, 1}}));
    EXPECT_TRUE(world_->set_tick(kPassiveTick_s));
    double most_J = 0.0;
    const double stored_J = energy_J();
    for (std::size_t k = 0; k < kTicksOfAGrasping; ++k) {
      move(k);
      world_->touch(tools_, touches_);
      // A force acts while the hand moves on to the next tick.
      double to_hands_J = 0.0;
      for (std::size_t i = 0; i < tools_.size(); ++i) {
        to_hands_J += kPassiveTick_s * touches_[i].force_W.dot(tools_[i].v_W);
      }
      const double now_J = energy_J();
      given_J_ += to_hands_J;
      most_J = std::max(most_J, given_J_ + now_J - stored_J);
      contacts_ += touches_[0].force_W.norm() > 0.0 ? 1 : 0;
    }
    return most_J;
  }

  [[nodiscard]] int contacts() const { return contacts_; }

 private:
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(*random_); }
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(*random_);
  }
  HandMotion motion(double most_m) {
    return {.amplitude_m = between(0.0, most_m) * direction(),
            .rate_rad_per_s = Vec3::Constant(between(3.0, 30.0)),
            .phase_rad = std::numbers::pi * Vec3(unit(), unit(), unit())};
  }
  Vec3 direction() {
    const double x = unit();
    const double y = unit();
    const double z = unit();
    return Vec3(x, y, z).normalized();
  }

  // Returns where a hand is at a tick, m. Both begin just outside, and press more and more.
  [[nodiscard]] Vec3 place_W(std::size_t hand, std::size_t k) const {
    constexpr double kPressing_ticks = 30.0;
    const double t_s = static_cast<double>(k) * kPassiveTick_s;
    const double pressed = std::clamp((static_cast<double>(k) - 3.0) / kPressing_ticks, 0.0, 1.0);
    const double depth_m = press_m_ * pressed - 1e-4 * (1.0 - pressed);
    const double side = hand == 0 ? -1.0 : 1.0;
    return side * (half_m_ + radius_m_ - depth_m) * Vec3::UnitX() + both_.offset_m(t_s) -
           both_.offset_m(0.0) + hands_[hand].offset_m(t_s) - hands_[hand].offset_m(0.0);
  }
  // The hands move evenly from tick to tick.
  void move(std::size_t k) {
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      const Vec3 now_W = place_W(i, k);
      tools_[i] = {.p_W = now_W, .v_W = (place_W(i, k + 1) - now_W) / kPassiveTick_s};
    }
  }
  // Returns the kinetic energy of the cube and its energy in the field of gravity, J.
  [[nodiscard]] double energy_J() const {
    const RigidBody& cube = *world_->body(0);
    const BodyMotion& motion = cube.motion();
    const Mat3 inertia_W =
        motion.rotation_WO * cube.mass().inertia_C * motion.rotation_WO.transpose();
    return 0.5 * cube.mass().mass_kg * motion.velocity_W.squaredNorm() +
           0.5 * motion.angular_momentum_W.dot(inertia_W.inverse() * motion.angular_momentum_W) +
           cube.mass().mass_kg * kStandardGravity_m_per_s2 * motion.center_W.y();
  }

  std::mt19937_64* random_;
  double half_m_;
  double press_m_;
  double radius_m_;
  ObjectBody body_;
  Object cube_;
  // The hands move together, and each a little by itself.
  HandMotion both_;
  std::array<HandMotion, 2> hands_;
  std::unique_ptr<WorldOf<2>> world_ = std::make_unique<WorldOf<2>>();
  std::array<ToolState, 2> tools_;
  std::array<Touch, 2> touches_;
  double given_J_ = 0.0;
  int contacts_ = 0;
};

TEST(GraspPassivity, HandsGetNoMoreThanHandsAndGravityHavePutIn) {
  constexpr std::uint64_t kSeed = 20261128;
  std::mt19937_64 random(kSeed);
  const auto graspings = std::size_t{share_of(4'000U)};
  double most_J = 0.0;
  int contacts = 0;
  for (std::size_t i = 0; i < graspings; ++i) {
    RandomGrasping grasping(random);
    const double made_J = grasping.most_made_J();
    EXPECT_LE(made_J, kTicksOfAGrasping * kMostMade_J) << "grasping " << i << ", seed " << kSeed;
    most_J = std::max(most_J, made_J);
    contacts += grasping.contacts();
  }
  std::printf("%zu graspings, %d ticks in contact; at most %.3g J made\n", graspings, contacts,
              most_J);
  EXPECT_GT(contacts, 0);
}

}  // namespace
}  // namespace tactus::rendering
