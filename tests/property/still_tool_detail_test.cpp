// A tool at rest on a surface with shading or bumps: the proxy comes to rest as well, also where
// the shifts of its goal have no place to settle, as on an edge between two faces that lean it each
// toward the other.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/property/wanderer.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/detail/shaded_solid.h"

namespace tactus::testing {
namespace {

using rendering::ContactMethod;
using rendering::Touch;

constexpr int kMostTicks = 100;
constexpr int kWatched = 20;
constexpr double kStill_m = 1e-9;

struct Detail {
  const char* name;
  bool is_shaded;
  bool is_bumpy;
};

constexpr std::array kDetails{Detail{"shaded", true, false}, Detail{"bumpy", false, true},
                              Detail{"shaded and bumpy", true, true}};

// A texture of bumps of up to 0.3 mm, 3 mm long, which lean a deep tool's force by much more than
// their length.
Picture bumps() {
  return Picture(
      {.use = rendering::TextureUse::bump, .tile_m = 0.003, .high = 0.0003}, 32,
      [](double u, double v) {
        return Vec3::Constant(0.5 + 0.25 * std::sin(6.283 * u) + 0.25 * std::sin(12.566 * v));
      });
}

// Puts the tool to rest in many places about the object, and expects the proxy to rest in each.
void expect_rest(const rendering::Object& object, const Shape& shape, std::uint64_t seed) {
  constexpr std::size_t kPlaces = 60;
  Hand hand(object, 0.002);
  Wanderer wanderer(shape, seed);
  for (std::size_t place = 0; place < share_of(kPlaces); ++place) {
    Vec3 tool;
    for (int tick = 0; tick < 50; ++tick) {
      tool = wanderer.next();
      hand.touch(tool);
    }
    Touch last;
    for (int tick = 0; tick < kMostTicks; ++tick) {
      last = hand.touch(tool);
    }
    for (int tick = 0; tick < kWatched; ++tick) {
      const Touch touch = hand.touch(tool);
      ASSERT_EQ(touch.flags & rendering::kTouchIterationsExhausted, 0U)
          << "seed " << seed << ", place " << place << ", tool " << tool.transpose();
      ASSERT_LE((touch.proxy_W - last.proxy_W).norm(), kStill_m)
          << "seed " << seed << ", place " << place << ", tool " << tool.transpose();
      ASSERT_LE((touch.force_W - last.force_W).norm(), 1e-6)
          << "seed " << seed << ", place " << place << ", tool " << tool.transpose();
      last = touch;
    }
  }
}

TEST(StillTool, ComesToRestOnShadingAndBumps) {
  std::vector<Shape> shapes = wandered_shapes();
  shapes.push_back(icosphere(0.03, 4));
  shapes.push_back(bumpy_sphere(0.03, 4, 0.3));
  const Picture texture = bumps();
  std::uint64_t seed = 1;
  for (const Shape& shape : shapes) {
    for (const rendering::Material& material : {kSlippery, kRough}) {
      const ShadedSolid solid(shape, 70.0, material);
      for (const auto& [name, is_shaded, is_bumpy] : kDetails) {
        for (const ContactMethod method :
             {ContactMethod::sphere_proxy, ContactMethod::feature_walk}) {
          rendering::Object object = is_shaded ? solid.shaded() : solid.flat();
          object = is_bumpy ? texture.on(object) : object;
          object.sides = shape.closed ? rendering::Sides::one : rendering::Sides::two;
          object.method = method;
          SCOPED_TRACE(::testing::Message()
                       << shape.name << ", " << name << ", method " << static_cast<int>(method)
                       << ", static friction " << material.friction.static_level);
          expect_rest(object, shape, ++seed);
        }
      }
    }
  }
}

}  // namespace
}  // namespace tactus::testing
