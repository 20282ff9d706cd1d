#include "tests/property/starts_in_touch.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "rendering/world/world.h"
#include "tests/support/brute_force.h"
#include "tests/support/solid.h"
#include "tests/support/triangle_grid.h"

namespace tactus::testing {
namespace {

using rendering::to_vec3;
using rendering::Touch;
using rendering::World;

// The shell is 0.75 um thick: from less than that on the tool may have left, and beyond it is free.
constexpr double kMayHaveLeft_m = 0.7e-6;
constexpr double kClear_m = 1e-6;

class Departure {
 public:
  Departure(World& world, TriangleGrid& triangles, double radius_m)
      : world_(world), triangles_(triangles), radius_m_(radius_m) {}

  [[nodiscard]] double clearance_at(const Vec3& p) { return clearance_along(p, p); }
  [[nodiscard]] double clearance_along(const Vec3& p, const Vec3& q) {
    const double within = radius_m_ + 2.0 * kClear_m;
    return clearance(triangles_.near(p, q, within), p, q, within) - radius_m_;
  }

  [[nodiscard]] bool has_left() const { return has_left_; }
  [[nodiscard]] bool has_arrived() const { return has_arrived_; }

  // False once the surface is met again.
  bool go_to(const Vec3& p) {
    if (has_left_ && clearance_along(last_, p) < kClear_m) {
      return false;
    }
    last_ = p;
    const Touch touch = world_.touch({.p_W = p});
    EXPECT_EQ(touch.force_W, Vec3::Zero()) << "felt before it has left, or after";
    // A tick that gathers triangles may end before the proxy has come to the tool.
    if ((touch.flags & rendering::kTouchIterationsExhausted) == 0) {
      EXPECT_EQ(touch.proxy_W, p);
    }
    has_arrived_ = touch.proxy_W == p;
    has_left_ = has_left_ || clearance_at(p) > kMayHaveLeft_m;
    return true;
  }

 private:
  World& world_;
  TriangleGrid& triangles_;
  double radius_m_;
  Vec3 last_ = Vec3::Zero();
  bool has_left_ = false;
  bool has_arrived_ = false;  // the proxy, in the last tick
};

}  // namespace

void leave_from(const StartCase& c, std::uint64_t seed, std::size_t starts, StartTally& tally) {
  constexpr int kTicks = 200;
  const Solid solid(c.shape, c.sides,
                    {.stiffness_N_per_m = 800.0,
                     .friction = rendering::cone_friction(c.friction, 0.7 * c.friction)});
  TriangleGrid triangles(corners_of(solid.shape()));
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = c.radius_m}));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::size_t n = 0; n < starts; ++n) {
    SCOPED_TRACE(c.shape.name + " seed " + std::to_string(seed) + " start " + std::to_string(n));
    const auto& [i, j, k] = solid.shape().triangles[random() % solid.shape().triangles.size()];
    const auto& vertices = solid.shape().vertices;
    const Vec3 middle = (to_vec3(vertices[i]) + to_vec3(vertices[j]) + to_vec3(vertices[k])) / 3.0;
    const Vec3 off(unit(random), unit(random), unit(random));
    const Vec3 start = middle + 0.57 * c.radius_m * off;
    const Vec3 away = Vec3(unit(random), unit(random), unit(random)).normalized();
    const double step_m = 0.5 * c.radius_m * std::pow(10.0, unit(random) - 1.0);
    world->reset();
    Departure departure(*world, triangles, c.radius_m);
    if (departure.clearance_at(start) > -kClear_m) {
      continue;
    }
    ++tally.starts;
    bool alone = departure.go_to(start);
    for (int tick = 1; tick < kTicks && alone; ++tick) {
      const Vec3 tremble = 0.2 * step_m * Vec3(unit(random), unit(random), unit(random));
      alone = departure.go_to(start + tick * step_m * away + tremble);
      ASSERT_FALSE(::testing::Test::HasFailure()) << "tick " << tick;
    }
    // A leap from across another piece of the surface would meet it on the way.
    alone = alone && departure.has_left();
    const Vec3 end = start + 1.0 * away;
    if (alone && departure.go_to(end)) {
      // A leap among many triangles takes the work of several ticks, without force.
      constexpr int kTicksToArrive = 50;
      for (int tick = 0; tick < kTicksToArrive && !departure.has_arrived(); ++tick) {
        departure.go_to(end);
      }
      EXPECT_TRUE(departure.has_arrived()) << "the proxy is held far from where it began";
      ++tally.ended;
    }
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
}

}  // namespace tactus::testing
