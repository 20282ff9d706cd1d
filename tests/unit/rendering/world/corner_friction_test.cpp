// Grooves between surfaces of different friction: every surface holds the proxy by its own model
// under its own part of the normal force. The oracles are the sum of the models' steady forces, a
// groove of one object, and the work along a closed path.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "rendering/friction/friction_model.h"
#include "rendering/world/world.h"
#include "tests/support/rows.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/friction/every_kind.h"
#include "tests/unit/rendering/world/groove.h"

namespace tactus::rendering {
namespace {

using testing::every_kind;
using testing::Groove;
using testing::kGrooveBristle_N_per_m;
using testing::kGrooveTick_s;
using testing::NamedFriction;
using testing::Side;
using testing::Solid;

// Returns what a steady slip takes, N per N of normal force.
double steady_force(const FrictionParameters& friction, double speed) {
  return steady_level(friction, speed) +
         (is_viscous(friction.kind) ? friction.viscous_s_per_m * speed : 0.0);
}

// Every kind of friction.
std::vector<NamedFriction> rough_kinds() {
  return every_kind(kGrooveBristle_N_per_m);
}

// Every kind with a fifth of it, and none.
std::vector<NamedFriction> smooth_kinds() {
  std::vector<NamedFriction> kinds;
  for (const NamedFriction& kind : rough_kinds()) {
    kinds.push_back({"smooth " + kind.name, scaled(kind.parameters, 0.2)});
  }
  kinds.push_back({"without friction", {}});
  return kinds;
}

TEST(CornerFriction, SlidesUnderTheSumOfTheModels) {
  constexpr double kSpeed_m_per_s = 0.05;
  constexpr double kDepth_m = 0.002;
  for (const NamedFriction& left : rough_kinds()) {
    for (const NamedFriction& right : smooth_kinds()) {
      for (const auto& [half_deg, softer] : {std::pair{45.0, 1.0}, {45.0, 0.25}, {30.0, 1.0}}) {
        for (const double x : {-0.0007, 0.0, 0.0011}) {
          if (!testing::is_taken()) {
            continue;
          }
          const Side first{1000.0, left.parameters};
          const Side second{1000.0 * softer, right.parameters};
          Groove groove(half_deg * std::numbers::pi / 180.0, first, second);
          Touch touch;
          for (int tick = 0; tick < 1500; ++tick) {
            touch = groove.touch({x, -kDepth_m, kSpeed_m_per_s * kGrooveTick_s * tick});
          }
          const auto pressure = groove.pressures_m(x, kDepth_m);
          const double expected =
              first.stiffness_N_per_m * pressure[0] * steady_force(first.friction, kSpeed_m_per_s) +
              second.stiffness_N_per_m * pressure[1] *
                  steady_force(second.friction, kSpeed_m_per_s);
          EXPECT_NEAR(-touch.force_W.z(), expected, 1e-3 * expected + 1e-4)
              << left.name << ", " << right.name << ", " << half_deg << " degrees, " << softer
              << ", x " << x;
        }
      }
    }
  }
}

// Strokes that start, stop and turn, along the groove and a little across.
class GrooveStroke {
 public:
  explicit GrooveStroke(std::uint64_t seed) : random_(seed) {}

  Vec3 next() {
    velocity_ += 0.02 * Vec3(0.02 * bell_(random_), 0.0, bell_(random_));
    velocity_ *= ++tick_ / 100 % 3 == 2 ? 0.0 : 0.95;
    place_ += kGrooveTick_s * velocity_;
    return {place_.x(), -0.002 + 0.001 * std::sin(0.013 * tick_), place_.z()};
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> bell_;
  Vec3 velocity_ = Vec3::Zero();
  Vec3 place_ = Vec3::Zero();
  int tick_ = 0;
};

TEST(CornerFriction, OfTwoObjectsOfOneMaterialIsThatOfOne) {
  constexpr float kHalf = 0.05F;
  testing::Shape valley{.name = "valley", .closed = false};
  valley.vertices = {{-kHalf, kHalf, -kHalf}, {-kHalf, kHalf, kHalf}, {0.0F, 0.0F, -kHalf},
                     {0.0F, 0.0F, kHalf},     {kHalf, kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
  valley.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
  for (const NamedFriction& kind : every_kind(kGrooveBristle_N_per_m)) {
    const Side side{800.0, kind.parameters};
    Groove two(0.25 * std::numbers::pi, side, side);
    const Solid one(valley, Sides::one,
                    {.stiffness_N_per_m = side.stiffness_N_per_m, .friction = side.friction});
    const Object& object = one.object();
    const auto world = std::make_unique<World>();
    ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.0}));
    ASSERT_TRUE(world->set_tick(kGrooveTick_s));
    world->touch({.p_W = {0.0, 0.01, 0.0}});
    GrooveStroke stroke(7);
    double largest_N = 0.0;
    for (int tick = 0; tick < 3000; ++tick) {
      const Vec3 tool = stroke.next();
      const Vec3 difference = two.touch(tool).force_W - world->touch({.p_W = tool}).force_W;
      largest_N = std::max(largest_N, difference.norm());
    }
    EXPECT_LE(largest_N, 1e-3) << kind.name;
  }
}

// The tool slides along the groove and slowly across it, so that first one and then the other
// surface is pressed more.
TEST(CornerFriction, ChangesContinuouslyFromOneSurfaceToTheOther) {
  for (const NamedFriction& left : rough_kinds()) {
    for (const NamedFriction& right : smooth_kinds()) {
      if (!testing::is_taken()) {
        continue;
      }
      Groove groove(0.25 * std::numbers::pi, {1000.0, left.parameters}, {1000.0, right.parameters});
      constexpr double kAcross_m = 2e-6;
      Vec3 before = Vec3::Zero();
      double largest_N = 0.0;
      for (int tick = 0; tick < 1300; ++tick) {
        const double x = -0.001 + std::max(tick - 300, 0) * kAcross_m;
        const Vec3 force = groove.touch({x, -0.002, 20e-6 * tick}).force_W;
        if (tick > 300) {
          largest_N = std::max(largest_N, (force - before).norm());
        }
        before = force;
      }
      // Two springs of 1000 N/m and their friction, over a step of kAcross_m.
      EXPECT_LE(largest_N, 2.0 * 1000.0 * kAcross_m * 2.0) << left.name << ", " << right.name;
    }
  }
}

// Returns the corners of a path that begins and ends out of contact and has six places in it. The
// order of drawing is that of a list, the same with every compiler.
std::vector<Vec3> closed_path(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Vec3> corners{{0.0, 0.001, 0.0}};
  for (int i = 0; i < 6; ++i) {
    const std::array<double, 3> drawn{any(random), any(random), any(random)};
    corners.emplace_back(0.0008 * drawn[0], -0.002 + 0.001 * drawn[1], 0.002 * drawn[2]);
  }
  corners.push_back(corners.front());
  return corners;
}

// Returns the work of the force on the tool along straight segments between the corners.
double given_out_J(Groove& groove, const std::vector<Vec3>& corners) {
  double work_J = 0.0;
  Vec3 force = groove.touch(corners.front()).force_W;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    constexpr int kSteps = 2000;
    const Vec3 step = (corners[i] - corners[i - 1]) / kSteps;
    for (int k = 1; k <= kSteps; ++k) {
      const Vec3 next = groove.touch(corners[i - 1] + k * step).force_W;
      work_J += 0.5 * (force + next).dot(step);
      force = next;
    }
  }
  return work_J;
}

// A path of the tool that comes back to its start in contact, with stops, and out of contact again.
TEST(CornerFriction, GivesNothingOutOnAClosedPath) {
  std::mt19937 random(3);
  for (const NamedFriction& left : rough_kinds()) {
    for (const NamedFriction& right : smooth_kinds()) {
      for (const double softer : {1.0, 0.2}) {
        if (!testing::is_taken()) {
          continue;
        }
        Groove groove(0.25 * std::numbers::pi, {1000.0, left.parameters},
                      {1000.0 * softer, right.parameters});
        EXPECT_LE(given_out_J(groove, closed_path(random)), 1e-9)
            << left.name << ", " << right.name << ", " << softer;
      }
    }
  }
}

// Cones hold the proxy still in the groove while the tool goes from where it presses one surface to
// where it presses the other one, which may be softer or harder.
TEST(CornerFriction, OfConesGivesNothingOutOnAnyClosedPath) {
  constexpr FrictionParameters kRoughCone{
      .kind = FrictionKind::cone, .coulomb = 0.5, .static_level = 0.8};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const int paths = testing::share_of(150);
  for (int path = 0; path < paths; ++path) {
    const double ratio = std::pow(5.0, any(random));
    Groove groove(0.25 * std::numbers::pi, {1000.0, kRoughCone},
                  {1000.0 * ratio, scaled(kRoughCone, 0.2)});
    EXPECT_LE(given_out_J(groove, closed_path(random)), 1e-9)
        << "path " << path << ", ratio " << ratio;
  }
}

}  // namespace
}  // namespace tactus::rendering
