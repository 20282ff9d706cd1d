// The proxy is where it belongs in every tick, however fast the tool is and however the triangles
// lie, and comes to rest under a tool at rest. The oracles are closed forms, the same solid
// upright, and a world without a limit on its budget.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "rendering/world/world.h"
#include "tests/property/wanderer.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::Sides;
using rendering::Touch;
using rendering::World;

std::unique_ptr<World> world_of(const Solid& solid, double radius_m) {
  auto world = std::make_unique<World>();
  EXPECT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = radius_m}));
  return world;
}

Sides sides_of(const Shape& shape) {
  return shape.closed ? Sides::one : Sides::two;
}

std::vector<Shape> fine_and_odd_shapes() {
  std::vector<Shape> shapes = wandered_shapes();
  shapes.push_back(icosphere(0.03, 6));
  shapes.push_back(bumpy_sphere(0.03, 6, 0.3));
  shapes.push_back(turned(prism(64, 0.005, 0.1), {1, 0, -1}, 0.9553166));
  return shapes;
}

TEST(StillTool, ComesToRestWithinAHundredTicks) {
  constexpr int kMostTicks = 100;
  constexpr int kWatched = 20;
  constexpr double kStill_m = 1e-9;
  const std::vector<Shape> shapes = fine_and_odd_shapes();
  const std::size_t places = share_of(std::size_t{10'000}) / (2 * shapes.size()) + 1;
  std::uint64_t seed = 1;
  for (const Shape& shape : shapes) {
    for (const rendering::Material& material : {kSlippery, kRough}) {
      const Solid solid(shape, sides_of(shape), material);
      const std::unique_ptr<World> world = world_of(solid, 0.002);
      Wanderer wanderer(shape, ++seed);
      for (std::size_t place = 0; place < places; ++place) {
        Vec3 tool;
        for (int tick = 0; tick < 50; ++tick) {
          tool = wanderer.next();
          world->touch({.p_W = tool});
        }
        Touch last;
        for (int tick = 0; tick < kMostTicks; ++tick) {
          last = world->touch({.p_W = tool});
        }
        for (int tick = 0; tick < kWatched; ++tick) {
          const Touch touch = world->touch({.p_W = tool});
          ASSERT_EQ(touch.flags & rendering::kTouchIterationsExhausted, 0U)
              << shape.name << ", place " << place << ", tool " << tool.transpose();
          ASSERT_LE((touch.proxy_W - last.proxy_W).norm(), kStill_m)
              << shape.name << ", place " << place << ", tool " << tool.transpose();
          last = touch;
        }
      }
    }
  }
}

// A sphere of 2 mm lies on the two edges of a slot, along which the tool draws it by 10 mm and
// stops.
TEST(StillTool, LeavesTheProxyAtRestInASlotAlongWhichItSlipped) {
  constexpr double kTool_m = 0.002;
  constexpr int kStrokeTicks = 300;
  for (const double gap_m : {0.001, 0.002, 0.003}) {
    const Solid solid(slotted_block(gap_m, 0.02), Sides::one, kRough);
    for (const double depth_m : {0.001, 0.003, 0.006}) {
      for (const double aside_m : {0.0, 0.3e-3, 1e-3}) {
        const std::unique_ptr<World> world = world_of(solid, kTool_m);
        Touch last;
        Vec3 tool;
        for (int tick = 0; tick <= kStrokeTicks; ++tick) {
          const double part = static_cast<double>(tick) / kStrokeTicks;
          const double above_m = 0.003 - (0.001 + depth_m) * std::min(1.0, 2.0 * part);
          tool = {aside_m * part, above_m, 0.01 * part};
          last = world->touch({.p_W = tool});
        }
        for (int tick = 0; tick < 100; ++tick) {
          const Touch touch = world->touch({.p_W = tool});
          ASSERT_LE((touch.proxy_W - last.proxy_W).norm(), tick < 10 ? 1e-5 : 1e-9)
              << "gap " << gap_m << ", depth " << depth_m << ", aside " << aside_m << ", tick "
              << tick;
          last = touch;
        }
      }
    }
  }
}

// A ball of 327,680 triangles is stroked 4 mm deep at up to 0.5 m/s. The proxy belongs on the ray
// through the tool.
TEST(FastStroke, KeepsUpWithTheToolOnAFineBall) {
  constexpr double kBall_m = 0.03;
  constexpr double kTool_m = 0.002;
  constexpr double kDepth_m = 0.004;
  constexpr double kMostBehind_m = 0.2e-3;
  constexpr double kPeriod_s = 1e-3;
  const Solid ball(icosphere(kBall_m, 7), Sides::one, kSlippery);
  for (const double speed_m_per_s : {0.1, 0.3, 0.5}) {
    const std::unique_ptr<World> world = world_of(ball, kTool_m);
    const double step = speed_m_per_s * kPeriod_s / (kBall_m + kTool_m);
    double worst_m = 0.0;
    const std::size_t ticks = part_of(std::size_t{4'000});
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      const double angle = step * static_cast<double>(tick);
      const Vec3 out{std::cos(angle) * 0.8, std::sin(angle), std::cos(angle) * 0.6};
      const double in = std::min(kDepth_m, 1e-4 * static_cast<double>(tick));
      const Touch touch = world->touch({.p_W = (kBall_m + kTool_m - in) * out});
      EXPECT_EQ(touch.flags, rendering::kTouchClean) << "tick " << tick;
      const double along = touch.proxy_W.dot(out);
      worst_m = std::max(worst_m, (touch.proxy_W - along * out).norm());
    }
    EXPECT_LE(worst_m, kMostBehind_m) << speed_m_per_s << " m/s";
    std::printf("%.1f m/s: at most %.1f um beside the ray\n", speed_m_per_s, 1e6 * worst_m);
  }
}

// A slim rod is stroked round and along, upright and turned to 26 directions.
TEST(SlimRod, GivesTheSameForceTurnedAsUpright) {
  constexpr double kRod_m = 0.005;
  constexpr double kDepth_m = 0.001;
  constexpr double kShare = 0.01;
  const Shape rod = prism(64, kRod_m, 0.1);
  const std::size_t ticks = part_of(std::size_t{400});
  for (const double radius_m : {0.0, 0.002}) {
    const auto tool_at = [&](std::size_t tick) {
      const double angle = 0.02 * static_cast<double>(tick);
      const double r = kRod_m + radius_m - kDepth_m;
      return Vec3{r * std::cos(angle), 0.03 * std::sin(0.3 * angle), r * std::sin(angle)};
    };
    const Solid upright(rod, Sides::one, kSlippery);
    const std::unique_ptr<World> straight = world_of(upright, radius_m);
    std::vector<double> forces_N;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      const Touch touch = straight->touch({.p_W = tool_at(tick)});
      forces_N.push_back(touch.force_W.norm());
    }
    for (int direction = 0; direction < 27; ++direction) {
      const int row = direction / 3 % 3;
      const int layer = direction / 9;
      const Vec3 axis{direction % 3 - 1.0, row - 1.0, layer - 1.0};
      if (axis.squaredNorm() == 0.0) {
        continue;
      }
      constexpr double kAngle_rad = 0.9553;
      const Solid solid(turned(rod, axis, kAngle_rad), Sides::one, kSlippery);
      const Eigen::AngleAxisd turn(kAngle_rad, axis.normalized());
      const std::unique_ptr<World> world = world_of(solid, radius_m);
      for (std::size_t tick = 0; tick < ticks; ++tick) {
        const Touch touch = world->touch({.p_W = turn * tool_at(tick)});
        ASSERT_NEAR(touch.force_W.norm(), forces_N[tick], kShare * forces_N[tick] + 1e-3)
            << "direction " << axis.transpose() << ", tick " << tick << ", radius " << radius_m;
      }
    }
  }
}

// Returns the vector, shortened to `most_m` if it is longer.
Vec3 at_most(const Vec3& v, double most_m) {
  const double length = v.norm();
  return length > most_m ? Vec3{most_m / length * v} : v;
}

// A hand at up to 1 m/s that stretches the proxy by up to 10 mm never reaches the budget: the world
// with one ends every tick where the one without does.
TEST(Budget, ChangesNothingUnderAHandsMotion) {
  constexpr double kMostStep_m = 1e-3;
  constexpr double kMostStretch_m = 0.01;
  const std::vector<Shape> shapes = fine_and_odd_shapes();
  const std::size_t ticks = share_of(std::size_t{400'000}) / (2 * shapes.size()) + 1;
  std::uint64_t seed = 100;
  for (const Shape& shape : shapes) {
    for (const rendering::Material& material : {kSlippery, kRough}) {
      const Solid solid(shape, sides_of(shape), material);
      const std::unique_ptr<World> bounded = world_of(solid, 0.002);
      const std::unique_ptr<World> unbounded = world_of(solid, 0.002);
      ASSERT_TRUE(unbounded->set_tick_budget(std::numeric_limits<double>::infinity()));
      Wanderer wanderer(shape, ++seed);
      Vec3 tool = wanderer.next();
      Vec3 proxy = tool;
      for (std::size_t tick = 0; tick < ticks; ++tick) {
        tool += at_most(wanderer.next() - tool, kMostStep_m);
        tool = proxy + at_most(tool - proxy, kMostStretch_m);
        const Touch touch = bounded->touch({.p_W = tool});
        const Touch judge = unbounded->touch({.p_W = tool});
        proxy = judge.proxy_W;
        ASSERT_EQ(touch.proxy_W, judge.proxy_W) << shape.name << ", tick " << tick;
        ASSERT_EQ(touch.flags, judge.flags) << shape.name << ", tick " << tick;
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
