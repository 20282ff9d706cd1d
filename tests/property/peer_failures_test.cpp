// Cases in which a well-known proxy renderer was measured to fail: bumpy and finely meshed surfaces
// that hold a frictionless proxy, facets felt as a buzz, friction that is not the coefficient,
// triangles too small to be felt. The oracles are the smooth shapes that the meshes approximate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "rendering/world/world.h"
#include "tests/support/brute_force.h"
#include "tests/support/shapes.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::FrictionState;
using rendering::Material;
using rendering::Sides;
using rendering::Touch;
using rendering::World;

constexpr double kTick_s = 1e-3;
constexpr double kStiffness = 1000.0;
constexpr double kDynamic = 0.4;
constexpr Material kSlippery{.stiffness_N_per_m = kStiffness};
constexpr Material kRough{.stiffness_N_per_m = kStiffness,
                          .friction = rendering::cone_friction(0.6, kDynamic)};

// The strokes that the renderer was measured with.
Vec3 stroke_direction(double t) {
  const double phi = 2.0 * t;
  const double theta = 0.4 * std::sin(2.0 * std::numbers::pi * 0.11 * t) +
                       0.01 * std::sin(2.0 * std::numbers::pi * 7.3 * t);
  return {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)};
}

double stroke_depth(double t) {
  return 0.002 + 0.001 * std::sin(2.0 * std::numbers::pi * 1.7 * t);
}

// Distance of the bumpy sphere's surface from its centre.
double bumpy_radius(const Vec3& u) {
  const double x = u.x();
  const double y = u.y();
  const double z = u.z();
  return 0.1 *
         (1.0 + 0.04 * std::sin(9 * x + 0.5) * std::sin(8 * y + 1.1) * std::sin(10 * z + 1.7) +
          0.015 * std::sin(21 * x + 2) * std::sin(23 * y + 0.3) * std::sin(19 * z + 0.9));
}

Shape star_shaped(int subdivisions, double (*radius)(const Vec3&)) {
  Shape shape = icosphere(1.0, subdivisions);
  for (rendering::Float3& vertex : shape.vertices) {
    const Vec3 u = rendering::to_vec3(vertex).normalized();
    const Vec3 p = radius(u) * u;
    vertex = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  }
  return shape;
}

// A gutter along z of half a circle, in facets of half a degree, open upward; its front inside.
Shape half_pipe(double radius_m) {
  constexpr int kFacets = 360;
  Shape shape{.name = "half-pipe", .closed = false};
  for (int i = 0; i <= kFacets; ++i) {
    const double angle = std::numbers::pi * i / kFacets;
    const auto x = static_cast<float>(-radius_m * std::cos(angle));
    const auto y = static_cast<float>(-radius_m * std::sin(angle));
    shape.vertices.push_back({x, y, -0.05F});
    shape.vertices.push_back({x, y, 0.05F});
  }
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    shape.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    shape.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  return shape;
}

class PeerFailures : public ::testing::Test {
 protected:
  void take(const Solid& solid, double radius_m) {
    ASSERT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = radius_m}));
  }
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

TEST_F(PeerFailures, NoTickIsStuckOnABumpySphereOf328kTriangles) {
  const Solid solid(star_shaped(7, bumpy_radius), Sides::one, kSlippery);
  const int ticks = std::max(4'000, part_of(20'000));
  for (const double radius_m : {0.0, 0.002}) {
    take(solid, radius_m);
    world_->touch({.p_W = {0.2, 0.0, 0.0}});
    double longest = 0.0;
    int stuck = 0;
    int cut_short = 0;
    Vec3 last = Vec3::Zero();
    for (int tick = 0; tick < ticks; ++tick) {
      const double t = tick * kTick_s;
      const Vec3 u = stroke_direction(t);
      const Vec3 tool = (bumpy_radius(u) + radius_m - stroke_depth(t)) * u;
      const Touch touch = world_->touch({.p_W = tool});
      cut_short += touch.flags != rendering::kTouchClean ? 1 : 0;
      longest = std::max(longest, (touch.proxy_W - tool).norm());
      stuck += touch.proxy_W == last ? 1 : 0;
      last = touch.proxy_W;
    }
    EXPECT_LE(longest, 1.05 * 0.003) << "radius " << radius_m;
    EXPECT_EQ(stuck, 0) << "radius " << radius_m;
    EXPECT_LE(cut_short, 300) << "radius " << radius_m;
    RecordProperty("longest_stretch_mm", std::to_string(1e3 * longest));
  }
}

TEST_F(PeerFailures, AHalfPipeInHalfDegreeFacetsIsSlidThroughFreely) {
  constexpr double kRadius_m = 0.03;
  const Solid solid(half_pipe(kRadius_m), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 0.002}) {
    take(solid, radius_m);
    world_->touch({.p_W = {0.0, -0.02, 0.0}});
    for (int tick = 0; tick < 4000; ++tick) {
      const double angle = 1.2 * std::sin(3.0 * tick * kTick_s);
      const Vec3 out(std::sin(angle), -std::cos(angle), 0.0);
      const Vec3 tool = (kRadius_m - radius_m + 0.002) * out;
      const Touch touch = world_->touch({.p_W = tool});
      // A facet's middle is 0.3 um nearer to the axis than its edges.
      ASSERT_LE((touch.proxy_W - (kRadius_m - radius_m) * out).norm(), 2e-5) << "tick " << tick;
      ASSERT_NEAR(touch.force_W.norm(), 2.0, 0.01) << "tick " << tick;
    }
  }
}

// The surface point of a convex mesh nearest to p, and the way out there, by brute force.
struct ExactProxy {
  const Shape& shape;
  std::vector<Corners> corners = corners_of(shape);

  // Returns the proxy of a sphere whose centre is the tool. From inside, two neighbouring facets
  // can both be nearest for the proxy that is on them, so forces are compared with a margin.
  [[nodiscard]] Vec3 proxy(const Vec3& tool, double radius_m) const {
    double nearest = 1.0;
    Vec3 point = tool;
    Vec3 out = tool.normalized();
    for (const Corners& t : corners) {
      const double to_ball = (t.centre - tool).norm() - t.radius_m;
      if (to_ball >= nearest) {
        continue;
      }
      const Vec3 at = nearest_point(t, tool);
      if ((tool - at).norm() < nearest) {
        nearest = (tool - at).norm();
        point = at;
        const Vec3 front = (t.b - t.a).cross(t.c - t.a).normalized();
        const bool outside = front.dot(tool - t.a) > 0.0;
        out = outside ? Vec3{(tool - at).normalized()} : front;
      }
    }
    return point + radius_m * out;
  }
};

// A mesh has a ripple of its own, where the proxy passes from facet to facet: that of the exact
// proxy.
TEST_F(PeerFailures, TheForceRipplesLittleMoreThanTheExactProxysOwn) {
  const Solid solid(icosphere(0.1, 5), Sides::one, kSlippery);
  const ExactProxy exact{solid.shape()};
  for (const double radius_m : {0.0, 0.002}) {
    take(solid, radius_m);
    world_->touch({.p_W = {0.2, 0.0, 0.0}});
    Vec3 last = Vec3::Zero();
    Vec3 last_ideal = Vec3::Zero();
    double ripple = 0.0;
    double ideal_ripple = 0.0;
    for (int tick = 0; tick < std::max(300, part_of(1000)); ++tick) {
      const double t = tick * kTick_s;
      const Vec3 tool = (0.1 + radius_m - stroke_depth(t)) * stroke_direction(t);
      const Vec3 force = world_->touch({.p_W = tool}).force_W;
      const Vec3 ideal = kStiffness * (exact.proxy(tool, radius_m) - tool);
      if (tick > 10) {
        ripple += (force - last).squaredNorm();
        ideal_ripple += (ideal - last_ideal).squaredNorm();
        ASSERT_LE(force.norm(), 1.02 * ideal.norm()) << "tick " << tick << ", radius " << radius_m;
      }
      last = force;
      last_ideal = ideal;
    }
    EXPECT_LE(std::sqrt(ripple / ideal_ripple), 1.2) << "radius " << radius_m;
  }
}

TEST_F(PeerFailures, FrictionIsItsCoefficientWithinOnePercentFromAMillimetreToAMetreASecond) {
  const Solid solid(flat_sheet(0.0005, 400), Sides::one, kRough);
  for (const double radius_m : {0.0, 0.002}) {
    for (const double speed : {0.001, 0.01, 0.1, 1.0}) {
      take(solid, radius_m);
      world_->touch({.p_W = {-0.08, 0.01, 0.0}});
      int slipping = 0;
      const int ticks = static_cast<int>(std::min(4000.0, 0.15 / (speed * kTick_s)));
      const Vec3 along = Vec3(1.0, 0.0, 0.3).normalized();
      for (int tick = 0; tick < ticks; ++tick) {
        const Vec3 tool = Vec3(-0.08, radius_m - 0.002, 0.0) + (speed * kTick_s * tick) * along;
        const Touch touch = world_->touch({.p_W = tool});
        const double tangential = std::hypot(touch.force_W.x(), touch.force_W.z());
        if (tick * speed * kTick_s > 0.002) {
          ASSERT_EQ(touch.friction, FrictionState::slip);
          ASSERT_NEAR(tangential / touch.force_W.y(), kDynamic, 0.01 * kDynamic)
              << "speed " << speed << ", radius " << radius_m << ", tick " << tick;
          ++slipping;
        }
      }
      EXPECT_GT(slipping, 70);
    }
  }
}

TEST_F(PeerFailures, TrianglesWithLegsOfAMicrometreAreFelt) {
  const Solid solid(flat_sheet(1e-6, 200), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 2e-5, 0.002}) {
    take(solid, radius_m);
    world_->touch({.p_W = {0.0, radius_m + 0.001, 0.0}});
    for (int tick = 0; tick < part_of(200); ++tick) {
      const Vec3 tool(1e-7 * tick, radius_m - 1e-5 * tick, 0.5e-7 * tick);
      const Touch touch = world_->touch({.p_W = tool});
      ASSERT_NEAR(touch.proxy_W.y(), radius_m, 1e-6) << "radius " << radius_m << " tick " << tick;
    }
  }
}

TEST_F(PeerFailures, ABadPositionGivesABoundedForceAndABitAndTheNextGoodTickIsFelt) {
  const Solid solid(icosphere(0.1, 5), Sides::one, kSlippery);
  take(solid, 0.002);
  world_->touch({.p_W = {0.2, 0.0, 0.0}});
  const Vec3 pressed(0.1, 0.0, 0.0);
  const Touch before = world_->touch({.p_W = pressed});
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e6, -1e6}) {
    const Touch touch = world_->touch({.p_W = {0.1, bad, 0.0}});
    EXPECT_EQ(touch.force_W, Vec3::Zero());
    EXPECT_EQ(touch.flags, rendering::kTouchToolInvalid);
    const Touch after = world_->touch({.p_W = pressed});
    EXPECT_LE((after.force_W - before.force_W).norm(), 2e-3);
    EXPECT_EQ(after.flags, rendering::kTouchClean);
  }
}

}  // namespace
}  // namespace tactus::testing
