// A tool slides over the seam of two objects that lie flush. The oracle is Coulomb's law: the
// friction is the same before, on and behind the seam.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

constexpr double kFlushDepth_m = 0.002;
constexpr Material kFlush{.stiffness_N_per_m = 500.0, .friction = cone_friction(0.5, 0.5)};

enum class FlushKind : std::uint8_t { box, cylinder, mesh };

// An object whose top lies at y = 0, from x = 0 to 40 mm to the left or to the right.
class FlushObject {
 public:
  FlushObject(FlushKind kind, double side) : kind_(kind), mesh_(shifted(side), Sides::one, kFlush) {
    object_ = {.surface = SurfaceKind::primitive, .material = kFlush};
    object_.primitive.X_WO.translation = {side * kHalf_m, -kHalf_m, 0.0};
    object_.primitive.kind =
        kind == FlushKind::cylinder ? PrimitiveKind::cylinder : PrimitiveKind::box;
    object_.primitive.dimensions_m = {kHalf_m, kHalf_m, kHalf_m};
  }

  [[nodiscard]] Object object() const {
    return kind_ == FlushKind::mesh ? mesh_.object() : object_;
  }

 private:
  static constexpr double kHalf_m = 0.02;

  static testing::Shape shifted(double side) {
    testing::Shape shape = testing::box(Vec3::Constant(2.0 * kHalf_m));
    Float3 lower = shape.vertices.front();
    for (const Float3& vertex : shape.vertices) {
      lower = {std::min(lower.x, vertex.x), std::min(lower.y, vertex.y),
               std::min(lower.z, vertex.z)};
    }
    for (Float3& vertex : shape.vertices) {
      vertex.x -= lower.x + (side < 0.0 ? 2.0F * static_cast<float>(kHalf_m) : 0.0F);
      vertex.y -= lower.y + 2.0F * static_cast<float>(kHalf_m);
      vertex.z -= lower.z + static_cast<float>(kHalf_m);
    }
    return shape;
  }

  FlushKind kind_;
  Solid mesh_;
  Object object_;
};

std::string name_of(FlushKind kind) {
  return kind == FlushKind::box ? "box" : kind == FlushKind::cylinder ? "cylinder" : "mesh";
}

// Slides along x over the seam, there and back.
void expect_even_friction(FlushKind left, FlushKind right, double radius_m) {
  const FlushObject first(left, -1.0);
  const FlushObject second(right, 1.0);
  const std::array objects{first.object(), second.object()};
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = radius_m}));
  ASSERT_TRUE(world->set_tick(1e-3));
  for (const double direction : {1.0, -1.0}) {
    for (const double step_m : {10e-6, 3.7e-6}) {
      constexpr double kFrom_m = 0.003;
      const double height_m = radius_m - kFlushDepth_m;
      world->touch({.p_W = {-direction * kFrom_m, radius_m + 0.001, 0.0}});
      for (double x = -kFrom_m; x < kFrom_m; x += step_m) {
        const Touch touch = world->touch({.p_W = {direction * x, height_m, 0.0}});
        if (x < -0.001) {
          continue;  // until the proxy slips steadily
        }
        ASSERT_NEAR(touch.force_W.y(), 1.0, 2e-3)
            << name_of(left) << ", " << name_of(right) << ", radius " << radius_m << ", x " << x;
        ASSERT_NEAR(touch.force_W.x(), -0.5 * direction, 2e-3)
            << name_of(left) << ", " << name_of(right) << ", radius " << radius_m << ", x " << x;
      }
      world->touch({.p_W = {direction * kFrom_m, radius_m + 0.001, 0.0}});
    }
  }
}

TEST(FlushSeam, DoesNotHoldAToolWithFriction) {
  for (const FlushKind left : {FlushKind::box, FlushKind::cylinder, FlushKind::mesh}) {
    for (const FlushKind right : {FlushKind::box, FlushKind::cylinder, FlushKind::mesh}) {
      for (const double radius_m : {0.0, 0.002}) {
        expect_even_friction(left, right, radius_m);
      }
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
