// A primitive feels the same touched as a primitive, as a triangle mesh and as a formula: the same
// motion of the hand brings the proxy to the same places, and the hand feels the same force. The
// oracle is the closed form of those places.
//
// The bounds:
//
// - A mesh of a round solid is off by its chords, and its faces are tilted against the surface.
//   Without friction the line from the proxy to the tool is normal to the surface, so a face tilted
//   by e moves the proxy aside by d e, d the depth, and by d e / (1 - d k) where the surface bulges
//   with the curvature k; the hand keeps d k <= kMostOfReach. With friction the pull is mu d, the
//   tilt changes it by (1 + mu^2) d e / (1 - mu e), and it falls by 1 - (1 + mu^2) d k along the
//   slide. The chords count four times: two walls that meet at 30 degrees shift their crease by so
//   much.
// - A formula rests 0.1 um above the surface, a primitive and a mesh 0.5 um. In a crease it takes
//   the nearest of its places, at the rest height or lower: one that is lower by the rest height t
//   is as near as one that is sqrt(2 d t) aside.
// - In a tick the proxy slides straight on a surface that turns: less than half of the tool's step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/mesh/primitive_mesh.h"
#include "rendering/world/world.h"
#include "tests/property/closed_form.h"
#include "tests/property/fine_mesh.h"
#include "tests/property/formula_of_shape.h"
#include "tests/property/touching_hand.h"
#include "tests/support/materials.h"
#include "tests/support/primitive_points.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::Object;
using rendering::Primitive;
using rendering::PrimitiveKind;
using rendering::Sides;
using rendering::Touch;
using rendering::World;

constexpr double kMu = 0.6;
const rendering::Material kAsRough{.stiffness_N_per_m = 1000.0,
                                   .friction = rendering::cone_friction(kMu, kMu)};
constexpr double kRest_m = 0.5e-6;
constexpr double kFormulaRest_m = 0.1e-6;

Primitive any_solid(PrimitiveKind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> length(0.012, 0.032);
  Primitive solid = random_primitive(kind, random);
  solid.dimensions_m = {length(random), length(random), length(random)};
  if (kind == PrimitiveKind::torus) {
    solid.dimensions_m = {0.01 + length(random), 0.5 * length(random), 0.0};
  }
  return solid;
}

// Returns true if walls meet in creases on the side that is touched.
bool has_creases(const TouchedShape& shape) {
  const PrimitiveKind kind = shape.primitive.kind;
  return shape.side == Side::within && (kind == PrimitiveKind::box || kind == PrimitiveKind::cone ||
                                        kind == PrimitiveKind::cylinder);
}

// One representation of a shape in a world of its own.
struct Representation {
  std::string name;
  MeshError error;
  // The most that the proxy may be beside its place, m, where the error of the mesh is not the
  // reason.
  double off_m = 0.0;
  // The most that it may be below its rest height in a crease, m.
  double low_m = 0.0;
  std::unique_ptr<World> world;

  // Returns how far the proxy may be beside its place without friction, m.
  [[nodiscard]] double most_m(double depth_m, double mu = 0.0) const {
    const double tilted = depth_m * std::tan(error.tilt) / (1.0 - TouchingHand::kMostOfReach);
    return off_m + 4.0 * error.chord_m + (1.0 + mu * mu) * tilted +
           std::sqrt(2.0 * depth_m * low_m);
  }
};

// A mesh with its error.
struct MeshOfShape {
  Shape shape;
  MeshError error;
};

// Returns a fine mesh of a primitive and the one that the tools draw, but for the plane, which they
// draw too small.
std::vector<MeshOfShape> meshes_of(const Primitive& primitive, int sides) {
  std::vector<Shape> shapes{fine_mesh(primitive, sides)};
  if (primitive.kind != PrimitiveKind::plane) {
    const host::TriangleMesh drawn = host::primitive_mesh(primitive);
    shapes.push_back({.name = "drawn", .vertices = drawn.vertices, .triangles = drawn.triangles});
  }
  std::vector<MeshOfShape> meshes;
  for (Shape& shape : shapes) {
    const MeshError error = error_of(shape, primitive);
    meshes.push_back({std::move(shape), error});
  }
  return meshes;
}

// A shape in all its representations.
class Representations {
 public:
  Representations(const TouchedShape& shape, Sides sides, const rendering::Material& material,
                  const std::vector<MeshOfShape>& meshes)
      : shape_(shape),
        primitive_{.surface = rendering::SurfaceKind::primitive,
                   .primitive = shape.primitive,
                   .sides = sides,
                   .material = material},
        formula_(formula_of(shape, sides, material)) {
    constexpr double kPrimitive_m = 0.1e-6;
    constexpr double kMesh_m = 1e-6;
    add("primitive", primitive_, {.off_m = kPrimitive_m});
    for (const MeshOfShape& mesh : meshes) {
      solids_.push_back(std::make_unique<Solid>(mesh.shape, sides, material));
      add(mesh.shape.name, solids_.back()->object(), {.error = mesh.error, .off_m = kMesh_m});
    }
    if (formula_) {
      add("formula", formula_->object,
          {.off_m = kRest_m, .low_m = has_creases(shape) ? kFormulaRest_m : 0.0});
    }
  }

  std::vector<Representation>& all() { return all_; }

 private:
  void add(const std::string& name, const Object& object, Representation one) {
    one.name = name;
    one.world = std::make_unique<World>();
    EXPECT_TRUE(one.world->set_scene({&object, 1}, {.tool_radius_m = shape_.tool_radius_m}))
        << name;
    all_.push_back(std::move(one));
  }

  const TouchedShape& shape_;
  Object primitive_;
  std::vector<std::unique_ptr<Solid>> solids_;
  std::optional<FormulaOfShape> formula_;
  std::vector<Representation> all_;
};

class SameShape : public ::testing::TestWithParam<PrimitiveKind> {
 protected:
  // Calls `test` with shapes of the kind, from outside and from within, by a point and a sphere.
  template <class Test>
  void with_shapes(const Test& test) {
    std::mt19937_64 random(1 + static_cast<std::uint64_t>(GetParam()));
    for (int round = 0; round < share_of(1); ++round) {
      const Primitive solid = any_solid(GetParam(), random);
      const auto meshes = meshes_of(solid, std::max(kFewestSides, part_of(kSides)));
      for (const Side side : {Side::outside, Side::within}) {
        for (const double tool_m : {0.0, 0.002}) {
          SCOPED_TRACE("round " + std::to_string(round) +
                       (side == Side::outside ? ", outside" : ", within") + ", tool " +
                       std::to_string(tool_m));
          test(TouchedShape{.primitive = solid, .tool_radius_m = tool_m, .side = side}, meshes);
          if (HasFatalFailure()) {
            return;
          }
        }
      }
    }
  }

  static Sides sides_of(const TouchedShape& shape) {
    return shape.side == Side::within || shape.tool_radius_m > 0.0 ? Sides::two : Sides::one;
  }

  static constexpr int kSides = 240;
  static constexpr int kFewestSides = 60;
  static constexpr int kTicks = 1500;
  static constexpr int kFewestTicks = 200;
};

TEST_P(SameShape, RestsWhereTheClosedFormSays) {
  constexpr double kStiffness_N_per_m = 1000.0;
  constexpr double kStep_m = 1e-3;
  int contacts = 0;
  int all_ticks = 0;
  with_shapes([&](const TouchedShape& shape, const std::vector<MeshOfShape>& meshes) {
    Representations shapes(shape, sides_of(shape), kSlippery, meshes);
    TouchingHand hand(shape, kStep_m, 7);
    const int ticks = std::max(kFewestTicks, part_of(kTicks));
    for (int tick = 0; tick < ticks; ++tick) {
      const Vec3 tool = hand.next();
      const Vec3 place = resting_place(shape, tool, kRest_m);
      const double depth_m = (place - tool).norm();
      contacts += depth_m > 0.0 ? 1 : 0;
      for (const Representation& one : shapes.all()) {
        const Touch touch = one.world->touch({.p_W = tool});
        const double most_m = one.most_m(depth_m);
        ASSERT_EQ(touch.flags, rendering::kTouchClean) << one.name << ", tick " << tick;
        ASSERT_LE((touch.proxy_W - place).norm(), most_m) << one.name << ", tick " << tick;
        ASSERT_LE((touch.force_W - kStiffness_N_per_m * (place - tool)).norm(),
                  kStiffness_N_per_m * most_m)
            << one.name << ", tick " << tick;
      }
    }
    all_ticks += ticks;
  });
  // A short part of the path may hardly touch.
  EXPECT_GT(contacts, part_of(kTicks) >= kTicks ? all_ticks / 20 : 0);
}

// The hand moves at up to 0.1 m/s. In creases the test is that the proxy lags by no more than the
// friction of all walls.
TEST_P(SameShape, SlidesByCoulombsLaw) {
  constexpr double kStep_m = 1e-4;
  with_shapes([&](const TouchedShape& shape, const std::vector<MeshOfShape>& meshes) {
    Representations shapes(shape, sides_of(shape), kAsRough, meshes);
    TouchingHand hand(shape, kStep_m, 8);
    SlidingPoint point(shape, kMu, kRest_m);
    const int ticks = std::max(kFewestTicks, part_of(kTicks));
    for (int tick = 0; tick < ticks; ++tick) {
      const Vec3 tool = hand.next();
      const Vec3 frictionless = resting_place(shape, tool, kRest_m);
      const double depth_m = (frictionless - tool).norm();
      // In a crease and in a corner every wall adds its friction, and each has a part of the depth.
      const bool may_lag = has_creases(shape);
      const Vec3 place = may_lag ? frictionless : point.follow(tool);
      const double lag_m = may_lag ? std::sqrt(3.0) * kMu * depth_m : 0.5 * kStep_m;
      for (const Representation& one : shapes.all()) {
        const Touch touch = one.world->touch({.p_W = tool});
        ASSERT_LE((touch.proxy_W - place).norm(), one.most_m(depth_m, kMu) + lag_m)
            << one.name << ", tick " << tick << ", depth " << depth_m;
      }
    }
  });
}

// However fast the hand is, the pull along a smooth surface never exceeds the friction. A mesh may
// tilt the normal, but no seam of it is a slope.
TEST_P(SameShape, HoldsBackNoMoreThanByFriction) {
  constexpr double kStep_m = 1e-3;
  with_shapes([&](const TouchedShape& shape, const std::vector<MeshOfShape>& meshes) {
    if (has_creases(shape)) {
      return;  // SlidesByCoulombsLaw bounds what several walls hold
    }
    Representations shapes(shape, sides_of(shape), kAsRough, meshes);
    TouchingHand hand(shape, kStep_m, 9);
    const int ticks = std::max(kFewestTicks, part_of(2 * kTicks));
    for (int tick = 0; tick < ticks; ++tick) {
      const Vec3 tool = hand.next();
      for (const Representation& one : shapes.all()) {
        const Touch touch = one.world->touch({.p_W = tool});
        const Vec3 normal = clearance(shape, touch.proxy_W).away_W;
        const Vec3 pull = tool - touch.proxy_W;
        const double pressure_m = -pull.dot(normal);
        const double along_m = (pull + pressure_m * normal).norm();
        ASSERT_LE(along_m, std::tan(std::atan(kMu) + one.error.tilt) * pressure_m + kRest_m)
            << one.name << ", tick " << tick << ", pressed " << pressure_m;
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Primitives, SameShape, ::testing::ValuesIn(kAllPrimitives),
                         [](const auto& kind) {
                           return std::string(
                               rendering::kPrimitives[static_cast<std::size_t>(kind.param)].name);
                         });

}  // namespace
}  // namespace tactus::testing
