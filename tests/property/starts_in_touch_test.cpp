// A tool that begins in touch feels nothing until it has left, wherever it is put.
#include <gtest/gtest.h>

#include <memory>

#include "rendering/world/world.h"
#include "tests/property/starts_in_touch.h"
#include "tests/property/wanderer.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::Object;
using rendering::Sides;
using rendering::SurfaceKind;
using rendering::Touch;
using rendering::World;

TEST(StartsInTouch, FeelsNothingUntilItHasLeftAnyShape) {
  StartTally tally;
  std::uint64_t seed = 9001;
  const std::size_t starts = share_of(std::size_t{200});
  for (const Shape& shape : wandered_shapes()) {
    for (const double radius_m : {0.001, 0.004}) {
      for (const double friction : {0.0, 0.8}) {
        leave_from({shape, shape.closed ? Sides::one : Sides::two, radius_m, friction}, seed++,
                   starts, tally);
        if (HasFatalFailure()) {
          return;
        }
      }
    }
  }
  std::printf("%zu starts in touch, %zu came away\n", tally.starts, tally.ended);
  EXPECT_GT(tally.ended, tally.starts / 4);
}

// The tool moves from deep inside, where the sphere is clear of every face, to outside: it comes
// through the face from behind, and then stands across it.
TEST(StartsInTouch, ComesOutOfASolidWithoutAPushAndFeelsItAfterwards) {
  constexpr double kRadius_m = 0.002;
  constexpr double kHalf_m = 0.02;
  const Solid solid(box(Vec3::Constant(2.0 * kHalf_m)), Sides::one, {.stiffness_N_per_m = 800.0});
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = kRadius_m}));
  for (const double z : {0.0, 0.007, 0.019}) {
    world->reset();
    Touch touch;
    for (double y = 0.0; y < kHalf_m + kRadius_m + 0.001; y += 0.0001) {
      touch = world->touch({.p_W = {0.001, y, z}});
      ASSERT_EQ(touch.force_W, Vec3::Zero()) << y;
    }
    touch = world->touch({.p_W = {0.001, kHalf_m + 0.001, z}});
    EXPECT_NEAR(touch.force_W.y(), 0.8, 1e-3);
  }
}

// Neither wall of a gap narrower than the sphere holds it; the open end lets it out.
TEST(StartsInTouch, ComesOutOfAGapThatIsNarrowerThanItself) {
  constexpr double kRadius_m = 0.002;
  const Solid solid(slotted_block(0.003, 0.01), Sides::one, {.stiffness_N_per_m = 800.0});
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&solid.object(), 1}, {.tool_radius_m = kRadius_m}));
  double top = 0.0;
  for (const rendering::Float3& v : solid.shape().vertices) {
    top = std::max(top, static_cast<double>(v.y));
  }
  Touch touch;
  for (double y = top - 0.004; y < top + 0.01; y += 0.00005) {
    touch = world->touch({.p_W = {0.0, y, 0.0}});
    ASSERT_EQ(touch.force_W, Vec3::Zero()) << y;
    ASSERT_EQ(touch.proxy_W, Vec3(0.0, y, 0.0));
  }
  EXPECT_EQ(touch.flags, rendering::kTouchClean);
  touch = world->touch({.p_W = {0.0, top, 0.0}});
  EXPECT_GT(touch.force_W.y(), 0.5) << "and it does not go in again";
}

TEST(StartsInTouch, FeelsNothingOfAPrimitiveThatItOverlapsUntilItHasLeft) {
  constexpr double kRadius_m = 0.002;
  Object ball;
  ball.surface = SurfaceKind::primitive;
  ball.primitive.kind = rendering::PrimitiveKind::sphere;
  ball.primitive.dimensions_m = {0.02, 0.0, 0.0};
  ball.material = {.stiffness_N_per_m = 800.0};
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = kRadius_m}));
  for (const double from : {0.0, 0.0185, 0.0195, 0.0205, 0.0215}) {
    world->reset();
    for (double y = from; y < 0.025; y += 0.0001) {
      const Touch touch = world->touch({.p_W = {0.0, y, 0.0}});
      ASSERT_EQ(touch.force_W, Vec3::Zero()) << from << " to " << y;
      if (y > 0.0181 && y < 0.0219) {
        ASSERT_NE(touch.flags & rendering::kTouchOverlap, 0U) << y;
      } else if (y < 0.0179 || y > 0.0222) {
        ASSERT_EQ(touch.flags, rendering::kTouchClean) << y;
      }
    }
    EXPECT_NEAR(world->touch({.p_W = {0.0, 0.021, 0.0}}).force_W.y(), 0.8, 1e-3);
  }
}

}  // namespace
}  // namespace tactus::testing
