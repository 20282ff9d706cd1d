#include "tests/property/proxy_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/property/wanderer.h"
#include "tests/support/brute_force.h"
#include "tests/support/solid.h"
#include "tests/support/triangle_grid.h"

namespace tactus::testing {
namespace {

using rendering::ProxyPath;
using rendering::Touch;
using rendering::World;

constexpr double kTolerance_m = 1e-6;

void check_path(const ProxyPath& path, TriangleGrid& triangles, const ProxyCase& c,
                ProxyTally& tally) {
  const double within = c.radius_m + 1e-5;
  for (std::size_t k = 0; k + 1 < path.count; ++k) {
    const Vec3& from = path.points[k];
    const Vec3& to = path.points[k + 1];
    const double near = clearance(triangles.near(from, to, within), from, to, within);
    tally.worst_clearance_m = std::min(tally.worst_clearance_m, near - c.radius_m);
    ASSERT_GT(near, 0.0) << "the path crosses a triangle";
    ASSERT_GE(near, c.radius_m - kTolerance_m) << "the path cuts into a triangle";
  }
}

// Distance to the tool cannot be shortened, to first order, by any direction that the triangles in
// contact allow.
void check_minimum(const Touch& touch, const Vec3& tool, TriangleGrid& triangles,
                   const ProxyCase& c, ProxyTally& tally) {
  const Vec3& p = touch.proxy_W;
  const double reach = c.radius_m + kTolerance_m;
  const double left = descent_left(p, tool, triangles.near(p, p, reach), reach);
  tally.worst_descent_m = std::max(tally.worst_descent_m, left);
  ASSERT_LE(left, kTolerance_m) << "the proxy could come nearer to the tool";
}

}  // namespace

void ProxyTally::add(const ProxyTally& other) {
  contacts += other.contacts;
  unfinished += other.unfinished;
  worst_clearance_m = std::min(worst_clearance_m, other.worst_clearance_m);
  worst_descent_m = std::max(worst_descent_m, other.worst_descent_m);
}

void walk_about(const ProxyCase& c, std::uint64_t seed, std::size_t ticks, ProxyTally& tally) {
  const double mu = c.friction ? 0.6 : 0.0;
  const Solid solid(
      c.shape, c.sides,
      {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(mu, 0.7 * mu)});
  TriangleGrid triangles(corners_of(solid.shape()));
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = c.radius_m}));
  Wanderer tool(solid.shape(), seed);
  world->touch({.p_W = Wanderer::start()});
  ProxyPath path;
  SCOPED_TRACE(c.shape.name + " radius " + std::to_string(c.radius_m) + " seed " +
               std::to_string(seed));
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    SCOPED_TRACE("tick " + std::to_string(tick));
    const Vec3 p = tool.next();
    const Touch touch = world->touch({.p_W = p}, &path);
    tally.unfinished += touch.flags != 0 ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(check_path(path, triangles, c, tally));
    if (touch.planes == 0 && touch.flags == 0) {
      ASSERT_EQ(touch.proxy_W, p) << "without contact the proxy is at the tool";
      continue;
    }
    ++tally.contacts;
    if (!c.friction && touch.flags == 0) {
      ASSERT_NO_FATAL_FAILURE(check_minimum(touch, p, triangles, c, tally));
    }
  }
}

}  // namespace tactus::testing
