// Fingers that press bodies onto the ground: it holds a body against a finger's spring, and not in
// the measure of the body's mass alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

#include <Eigen/Dense>

#include "rendering/world/world.h"
#include "tests/support/rows.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::is_taken;
using testing::share_of;

constexpr double kPressTick_s = 1e-3;
constexpr double kPressStiffness_N_per_m = 3000.0;
constexpr double kCubeHalf_m = 0.02;
constexpr std::size_t kMostCubes = 3;

// The surfaces of the ground and the cubes of a pressing.
struct Pressing {
  double friction = 0.5;
  double damping_Ns_per_m = 0.0;
  double restitution = 0.0;
};

// Cubes upon each other on the ground; the world begins without them.
class PressedCubes {
 public:
  explicit PressedCubes(const Pressing& pressing) : pressing_(pressing) {
    objects_[0].surface = SurfaceKind::primitive;
    objects_[0].primitive.kind = PrimitiveKind::plane;
    objects_[0].material = material();
  }

  // Puts a cube on top. Its centre of mass is so far above its middle, and its inertia is so many
  // times that of a homogeneous one.
  void add(double mass_kg, double center_m = 0.0, double inertia = 1.0) {
    const Vec3 middle(0.0, top_m() + kCubeHalf_m, 0.0);
    const double moment = inertia * 2.0 / 3.0 * mass_kg * kCubeHalf_m * kCubeHalf_m;
    bodies_[count_] = {.mass = {.mass_kg = mass_kg,
                                .center_O = middle + center_m * Vec3::UnitY(),
                                .inertia_C = moment * Mat3::Identity()},
                       .restitution = pressing_.restitution};
    Object& cube = objects_[count_ + 1];
    cube.surface = SurfaceKind::primitive;
    cube.primitive = {.kind = PrimitiveKind::box,
                      .X_WO = {.translation = middle},
                      .dimensions_m = {kCubeHalf_m, kCubeHalf_m, kCubeHalf_m}};
    cube.material = material();
    cube.moves = true;
    cube.body = static_cast<std::uint8_t>(count_);
    ++count_;
  }

  [[nodiscard]] bool start() {
    return world_->set_scene(std::span(objects_).first(count_ + 1),
                             {.bodies = std::span(bodies_).first(count_)}) &&
           world_->set_tick(kPressTick_s);
  }

  // Returns the force on a finger so far below the top, at this place on it.
  Vec3 press(double depth_m, double x_m, double z_m) {
    return world_->touch(ToolState{.p_W = {x_m, top_m() - depth_m, z_m}}).force_W;
  }

  // Returns the height of the stack at the start, and the largest speed of a cube now.
  [[nodiscard]] double top_m() const { return 2.0 * kCubeHalf_m * static_cast<double>(count_); }
  [[nodiscard]] double fastest_m_per_s() const {
    double fastest = 0.0;
    for (std::uint32_t i = 1; i <= count_; ++i) {
      fastest = std::max(fastest, world_->body(i)->motion().velocity_W.norm());
    }
    return fastest;
  }

 private:
  [[nodiscard]] Material material() const {
    Material material;
    material.stiffness_N_per_m = kPressStiffness_N_per_m;
    material.damping_Ns_per_m = pressing_.damping_Ns_per_m;
    material.friction.coulomb = pressing_.friction;
    material.friction.static_level = pressing_.friction;
    return material;
  }

  Pressing pressing_;
  std::array<ObjectBody, kMostCubes> bodies_;
  std::array<Object, kMostCubes + 1> objects_;
  std::size_t count_ = 0;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// The finger comes down slowly at places up to the cube's rim, and stays. The friction of the
// ground keeps a little of the force with which a body of less than a gram is pressed at its rim.
void expect_spring(double mass_kg, double center_m, const Pressing& pressing, double place_m) {
  PressedCubes cubes(pressing);
  cubes.add(mass_kg, center_m);
  ASSERT_TRUE(cubes.start());
  const bool is_very_light = mass_kg < 1e-3;
  for (int i = -5; i < 200; ++i) {
    const double depth_m = 1e-5 * std::min(i, 100);
    const Vec3 felt_W = cubes.press(depth_m, place_m, place_m / 3.0);
    const double spring_N = kPressStiffness_N_per_m * std::max(0.0, depth_m);
    const double most_N = is_very_light ? 0.02 * spring_N + 0.003 : 0.01;
    ASSERT_LT((felt_W - spring_N * Vec3::UnitY()).norm(), most_N)
        << mass_kg << " kg at " << place_m << " m, centre " << center_m << " m, friction "
        << pressing.friction << ", damping " << pressing.damping_Ns_per_m << ", tick " << i;
  }
  EXPECT_LT(cubes.fastest_m_per_s(), is_very_light ? 1e-5 : 1e-9)
      << mass_kg << " kg at " << place_m << " m";
}

TEST(PressedBody, IsFeltAsTheSpringAndRests) {
  for (const double mass_kg : {5e-5, 1e-4, 1e-3, 0.01, 0.1, 1.0}) {
    for (const double place_m : {0.0, 0.018}) {
      for (const double damping : {0.0, 2.0}) {
        for (const double friction : {0.05, 0.5}) {
          for (const double center_m : {0.0, -kCubeHalf_m}) {
            if (!is_taken(7)) {
              continue;
            }
            const Pressing pressing{.friction = friction, .damping_Ns_per_m = damping};
            expect_spring(mass_kg, center_m, pressing, place_m);
          }
        }
      }
    }
  }
}

// A contact of a body that a finger drives onto the ground is a load and no hit, however elastic
// the surfaces are; a body that is thrown would be felt, too.
TEST(PressedBody, IsNotThrownByRestitution) {
  for (const double mass_kg : {5e-5, 2.4e-4, 1e-3, 0.1}) {
    PressedCubes cubes({.friction = 0.24, .damping_Ns_per_m = 2.9, .restitution = 0.9});
    cubes.add(mass_kg);
    ASSERT_TRUE(cubes.start());
    constexpr double kDeepest_m = 1.8e-3;
    for (int i = 0; i < 300; ++i) {
      const double depth_m = std::min(1.3e-4 * i - 2e-3, kDeepest_m);
      const Vec3 felt_W = cubes.press(depth_m, -0.006, -0.002);
      ASSERT_LT(felt_W.norm(), 1.01 * kPressStiffness_N_per_m * kDeepest_m) << mass_kg << " kg";
      ASSERT_LT(cubes.fastest_m_per_s(), 0.1) << mass_kg << " kg, tick " << i;
    }
  }
}

// Stacks of up to three cubes, none more than a thousand times as heavy as one below, under a
// finger that comes down anywhere, fast or slowly. The hand never feels more than the spring at the
// depth that the finger ends at, with friction.
TEST(PressedBody, NeverPushesMoreThanTheSpring) {
  std::mt19937_64 random(26);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const auto mass_between = [&](double least_kg, double most_kg) {
    return std::exp(between(std::log(least_kg), std::log(most_kg)));
  };
  const int pressings = share_of(100);
  for (int pressing = 0; pressing < pressings; ++pressing) {
    const double friction = between(0.02, 1.0);
    const double damping = std::max(0.0, between(-3.0, 3.0));
    const double restitution = std::max(0.0, between(-2.0, 0.8));
    PressedCubes cubes(
        {.friction = friction, .damping_Ns_per_m = damping, .restitution = restitution});
    constexpr double kLightest_kg = 5e-5;
    double most_kg = 0.5;
    const int count = std::uniform_int_distribution<int>(1, kMostCubes)(random);
    for (int i = 0; i < count; ++i) {
      const double mass_kg = mass_between(kLightest_kg, most_kg);
      most_kg = std::min(most_kg, 1000.0 * mass_kg);
      const double center_m = between(-0.9, 0.9) * kCubeHalf_m;
      const double inertia = between(0.3, 2.0);
      cubes.add(mass_kg, center_m, inertia);
    }
    ASSERT_TRUE(cubes.start());
    const double x_m = between(-0.018, 0.018);
    const double z_m = between(-0.018, 0.018);
    const double deepest_m = between(1e-4, 2e-3);
    const double step_m = between(5e-6, 3e-4);
    const double most_N = kPressStiffness_N_per_m * deepest_m * std::hypot(1.0, friction);
    for (int i = 0; i < 300; ++i) {
      const Vec3 felt_W = cubes.press(std::min(step_m * i - 2e-3, deepest_m), x_m, z_m);
      ASSERT_LT(felt_W.norm(), 1.02 * most_N + 0.003) << "pressing " << pressing << ", tick " << i;
      ASSERT_LT(cubes.fastest_m_per_s(), 1.0) << "pressing " << pressing << ", tick " << i;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
