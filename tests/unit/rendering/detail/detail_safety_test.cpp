// Shading and bumps shift the proxy's goal; that the proxy crosses nothing must not depend on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/brute_force.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/detail/shaded_solid.h"

namespace tactus::testing {
namespace {

using rendering::ProxyPath;
using rendering::Touch;

std::vector<Shape> shapes() {
  return {icosphere(0.03, 2),
          bumpy_sphere(0.03, 2, 0.2),
          box({0.04, 0.05, 0.06}),
          torus(0.03, 0.012, 16, 10),
          prism(16, 0.03, 0.04),
          star(5, 0.03, 0.012, 0.04),
          grooved_block(10, 0.03),
          blade(10, 0.04),
          pit(0.02, 0.03),
          box({0.05, 0.0001, 0.05}),
          height_field(0.08, 12, 0.006)};
}

Vec3 near_surface(const Shape& shape, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_int_distribution<std::size_t> pick(0, shape.vertices.size() - 1);
  return 0.5 * (to_vec3(shape.vertices[pick(random)]) + to_vec3(shape.vertices[pick(random)])) +
         0.004 * Vec3{unit(random), unit(random), unit(random)};
}

void wander(const Shape& shape, double radius_m, bool friction, std::uint64_t seed, int ticks) {
  const rendering::Material material{
      .stiffness_N_per_m = 1000.0,
      .friction = friction ? rendering::cone_friction(0.6, 0.4) : rendering::FrictionParameters{}};
  const ShadedSolid solid(shape, 70.0, material);
  const Picture bumps(
      {.use = rendering::TextureUse::bump, .tile_m = 0.003, .high = 0.0003}, 32,
      [](double u, double v) {
        return Vec3::Constant(0.5 + 0.25 * std::sin(6.283 * u) + 0.25 * std::sin(12.566 * v));
      });
  rendering::Object object = bumps.on(solid.shaded());
  object.sides = shape.closed ? rendering::Sides::one : rendering::Sides::two;
  Hand hand(object, radius_m);
  const std::vector<Corners> corners = corners_of(shape);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> speed(-6.0, -2.0);
  Vec3 tool{0.0, 0.2, 0.011};
  hand.touch(tool);
  ProxyPath path;
  int contacts = 0;
  for (int left = ticks; left > 0;) {
    const Vec3 target = near_surface(shape, random);
    const double step = std::pow(10.0, speed(random));
    for (int k = 0; k < 40 && left > 0; ++k, --left) {
      const Vec3 motion = target - tool;
      tool += std::min(1.0, step / std::max(motion.norm(), 1e-12)) * motion;
      const Touch touch = hand.touch(tool, &path);
      ASSERT_TRUE(touch.force_W.allFinite());
      contacts += touch.contact == rendering::ContactKind::none ? 0 : 1;
      for (std::size_t i = 0; i + 1 < path.count; ++i) {
        const double near = clearance(corners, path.points[i], path.points[i + 1], radius_m + 1e-5);
        ASSERT_GT(near, 0.0) << "the path crosses a triangle";
        ASSERT_GE(near, radius_m - 1e-6) << "the path cuts into a triangle";
      }
    }
  }
  EXPECT_GT(contacts, ticks / 20);
}

TEST(DetailSafety, NoShadedOrBumpySurfaceIsEverCrossed) {
  constexpr std::uint64_t kSeed = 20'25;
  constexpr int kTicksToTouch = 1500;
  const int ticks = std::max(kTicksToTouch, share_of(kTicksToTouch));
  std::uint64_t seed = kSeed;
  for (const Shape& shape : shapes()) {
    for (const double radius_m : {0.0, 0.002}) {
      for (const bool friction : {false, true}) {
        SCOPED_TRACE(::testing::Message() << shape.name << ", radius " << radius_m << ", friction "
                                          << friction << ", seed " << seed);
        wander(shape, radius_m, friction, seed++, ticks);
        if (::testing::Test::HasFatalFailure()) {
          return;
        }
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
