// The sphere proxy against brute force over all triangles: random tools on many meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "rendering/world/world.h"
#include "tests/property/wanderer.h"
#include "tests/support/brute_force.h"
#include "tests/support/shapes.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::ProxyPath;
using rendering::Sides;
using rendering::Touch;
using rendering::World;

constexpr double kTolerance_m = 1e-6;
// Fewer ticks on a shape may pass beside it.
constexpr std::size_t kTicksToMeetEveryShape = 2'000;

struct Case {
  Shape shape;
  Sides sides;
  double radius_m;
  bool friction;
};

struct Tally {
  std::size_t contacts = 0;
  std::size_t unfinished = 0;
  double worst_clearance_m = 1.0;
  double worst_descent_m = 0.0;
};

void check_path(const ProxyPath& path, std::span<const Corners> corners, const Case& c,
                Tally& tally) {
  for (std::size_t k = 0; k + 1 < path.count; ++k) {
    const double near = clearance(corners, path.points[k], path.points[k + 1], c.radius_m + 1e-5);
    tally.worst_clearance_m = std::min(tally.worst_clearance_m, near - c.radius_m);
    ASSERT_GT(near, 0.0) << "the path crosses a triangle";
    ASSERT_GE(near, c.radius_m - kTolerance_m) << "the path cuts into a triangle";
  }
}

// Distance to the tool cannot be shortened, to first order, by any direction that the triangles in
// contact allow.
void check_minimum(const Touch& touch, const Vec3& tool, std::span<const Corners> corners,
                   const Case& c, Tally& tally) {
  std::vector<Vec3> normals;
  for (const Corners& t : corners) {
    const Vec3 offset = touch.proxy_W - nearest_point(t, touch.proxy_W);
    if (offset.norm() <= c.radius_m + kTolerance_m) {
      normals.push_back(offset.normalized());
    }
  }
  const double left = descent_left(touch.proxy_W, tool, normals);
  tally.worst_descent_m = std::max(tally.worst_descent_m, left);
  ASSERT_LE(left, kTolerance_m) << "the proxy could come nearer to the tool";
}

void run(const Case& c, std::uint64_t seed, std::size_t ticks, Tally& tally) {
  const double mu = c.friction ? 0.6 : 0.0;
  const Solid solid(
      c.shape, c.sides,
      {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(mu, 0.7 * mu)});
  const std::vector<Corners> corners = corners_of(solid.shape());
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = c.radius_m}));
  Wanderer tool(solid.shape(), seed);
  world->touch({.p_W = Wanderer::start()});
  ProxyPath path;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    SCOPED_TRACE(c.shape.name + " radius " + std::to_string(c.radius_m) + " seed " +
                 std::to_string(seed) + " tick " + std::to_string(tick));
    const Vec3 p = tool.next();
    const Touch touch = world->touch({.p_W = p}, &path);
    tally.unfinished += touch.flags != 0 ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(check_path(path, corners, c, tally));
    if (touch.planes == 0 && touch.flags == 0) {
      ASSERT_EQ(touch.proxy_W, p) << "without contact the proxy is at the tool";
      continue;
    }
    ++tally.contacts;
    if (!c.friction && touch.flags == 0) {
      ASSERT_NO_FATAL_FAILURE(check_minimum(touch, p, corners, c, tally));
    }
  }
}

TEST(SphereProxy, CrossesNoTriangleKeepsItsRadiusAndRestsAtALocalMinimum) {
  std::vector<Case> cases;
  for (const Shape& shape : wandered_shapes()) {
    for (const double radius_m : {0.0, 0.001, 0.004}) {
      cases.push_back({shape, shape.closed ? Sides::one : Sides::two, radius_m, false});
      cases.push_back({shape, Sides::two, radius_m, true});
    }
  }
  const std::size_t ticks = share_of(std::size_t{1'000'000}) / cases.size() + 1;
  Tally all;
  std::uint64_t seed = 1;
  for (const Case& c : cases) {
    Tally tally;
    run(c, seed++, ticks, tally);
    if (ticks >= kTicksToMeetEveryShape) {
      EXPECT_GT(tally.contacts, ticks / 100) << c.shape.name << ": the wanderer hardly touched it";
    }
    if (HasFatalFailure()) {
      return;
    }
    all.contacts += tally.contacts;
    all.unfinished += tally.unfinished;
    all.worst_clearance_m = std::min(all.worst_clearance_m, tally.worst_clearance_m);
    all.worst_descent_m = std::max(all.worst_descent_m, tally.worst_descent_m);
    if (tally.unfinished > 0) {
      std::printf("%-40s radius %.3f friction %d: %zu of %zu ticks unfinished\n",
                  c.shape.name.c_str(), c.radius_m, c.friction, tally.unfinished, ticks);
    }
  }
  std::printf(
      "%zu ticks on %zu cases, %zu in contact, %zu cut short by a limit; least clearance beyond "
      "the radius %.3f um, "
      "largest descent left %.3g um\n",
      ticks * cases.size(), cases.size(), all.contacts, all.unfinished, 1e6 * all.worst_clearance_m,
      1e6 * all.worst_descent_m);
  EXPECT_LE(all.unfinished, all.contacts / 1'000) << "sub-goals run out too often";
}

}  // namespace
}  // namespace tactus::testing
