// Friction in the crease of a formula. The oracle is a groove of two planes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/unit/rendering/friction/every_kind.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"
#include "tests/unit/rendering/world/groove.h"

namespace tactus::rendering {
namespace {

using testing::every_kind;
using testing::Groove;
using testing::kGrooveBristle_N_per_m;
using testing::kGrooveTick_s;
using testing::NamedFriction;
using testing::Side;

// The groove of the formula y - |x|, whose proxy is found by another method.
TEST(CreaseFriction, OfAFormulaIsThatOfItsPlanes) {
  const FormulaSurface valley("y - abs(x)");
  for (const NamedFriction& kind : every_kind(kGrooveBristle_N_per_m)) {
    const Side side{800.0, kind.parameters};
    const Material material{.stiffness_N_per_m = side.stiffness_N_per_m, .friction = side.friction};
    Groove planes(0.25 * std::numbers::pi, side, side);
    ImplicitTracker tracker;
    Vec3 before(0.0, 0.01, 0.0);
    tracker.place(before);
    double largest_N = 0.0;
    for (int tick = 0; tick < 1500; ++tick) {
      const Vec3 tool{-0.0008 + 1e-6 * tick, -0.002, 20e-6 * tick};
      tracker.begin_friction(tool - before, kGrooveTick_s);
      before = tool;
      const ImplicitRest rest = tracker.advance(valley.surface, material, tool);
      const Vec3 force = side.stiffness_N_per_m * (rest.proxy_W - tool);
      const Vec3 expected = planes.touch(tool).force_W;
      // The first ticks differ: on one wall or both, where the tool met the groove.
      if (tick >= 700) {
        largest_N = std::max(largest_N, (force - expected).norm());
      }
    }
    EXPECT_LE(largest_N, 2e-3) << kind.name;
  }
}

}  // namespace
}  // namespace tactus::rendering
