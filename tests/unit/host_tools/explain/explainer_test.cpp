// Explained ticks against what is known without them: multipliers in exact rational arithmetic
// (tests/reference/README.md), the friction circle's closed form, and the same ticks unexplained.
#include "host_tools/explain/explainer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "rendering/world/world.h"
#include "tests/support/csv.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::host {
namespace {

using rendering::FrictionState;
using rendering::Object;
using rendering::Touch;
using rendering::World;
using testing::Csv;
using testing::kRough;
using testing::kSlippery;
using testing::Solid;

// The proxy of a plane rests this far above it (rendering/contact/README.md), m.
constexpr double kRestHeight_m = 0.5e-6;

// One plane of a reference case, and the object that bounds the proxy by it.
struct ReferencePlane {
  Vec3 normal;
  double offset_m;
  double multiplier_m;
};

Object object_of(const ReferencePlane& plane) {
  Object object{.surface = rendering::SurfaceKind::primitive,
                .primitive = {.kind = rendering::PrimitiveKind::plane},
                .material = kSlippery};
  Mat3& rotation = object.primitive.X_WO.rotation;
  rotation.col(1) = plane.normal;
  rotation.col(0) = plane.normal.unitOrthogonal();
  rotation.col(2) = rotation.col(0).cross(rotation.col(1));
  object.primitive.X_WO.translation = (plane.offset_m - kRestHeight_m) * plane.normal;
  return object;
}

// Explains one tick of a world.
const ExplainedTick& explain(Explainer& explainer, World& world, const Vec3& tool) {
  explainer.begin();
  const Touch touch = world.touch({.p_W = tool}, &explainer);
  return explainer.finish(0, 0.0, tool, touch);
}

class ReferenceMultipliers : public ::testing::Test {
 protected:
  // Reads the planes of a row with unit normals.
  [[nodiscard]] std::vector<ReferencePlane> planes_of(std::size_t row) const {
    std::vector<ReferencePlane> planes;
    for (int i = 0; i < static_cast<int>(csv_.number(row, "m")); ++i) {
      const std::string k = std::to_string(i);
      const Vec3 n = csv_.vector(row, "n" + k);
      const double multiplier = csv_.number(row, "lambda" + k);
      planes.push_back({.normal = n.normalized(),
                        .offset_m = csv_.number(row, "d" + k) / n.norm(),
                        .multiplier_m = std::isnan(multiplier) ? 0.0 : multiplier * n.norm()});
    }
    return planes;
  }

  Csv csv_{"godobject_2000.csv"};
};

TEST_F(ReferenceMultipliers, AreThoseOfTheExplainedPlanes) {
  constexpr double kClear_m = 1e-3;
  constexpr double kTolerance_m = 1e-8;
  // Which planes are active is decided by more than the contact margin.
  constexpr double kDecided_m = 1e-6;
  const auto world = std::make_unique<World>();
  int checked = 0;
  for (std::size_t row = 0; row < csv_.rows(); ++row) {
    const bool has_one_answer = csv_.text(row, "status") == "OK" &&
                                csv_.number(row, "n_min_cardinality_optimal_sets") == 1 &&
                                csv_.number(row, "n_active") > 0 &&
                                csv_.number(row, "min_inactive_slack") > kDecided_m &&
                                csv_.number(row, "min_active_lambda_unit") > kDecided_m &&
                                csv_.number(row, "unit_gram_det_of_active_set") > 0.01;
    if (!has_one_answer) {
      continue;
    }
    const std::vector<ReferencePlane> planes = planes_of(row);
    Vec3 out = Vec3::Zero();
    std::vector<Object> objects;
    for (const ReferencePlane& plane : planes) {
      out += plane.normal;
      objects.push_back(object_of(plane));
    }
    const Vec3 start = csv_.vector(row, "g") + 0.02 * out;
    if (!std::ranges::all_of(planes, [&](const ReferencePlane& plane) {
          return plane.normal.dot(start) > plane.offset_m + kClear_m;
        })) {
      continue;
    }
    ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = 0.0}));
    world->touch({.p_W = start});
    Explainer explainer(0.0);
    const Vec3 tool = csv_.vector(row, "h");
    explain(explainer, *world, tool);
    const ExplainedTick& tick = explain(explainer, *world, tool);
    ASSERT_FALSE(tick.moves.empty()) << "row " << row;
    std::vector<double> multipliers(planes.size(), 0.0);
    for (const ExplainedPlane& plane : tick.moves.back().planes) {
      multipliers[plane.feature.object] += plane.multiplier_m;
      EXPECT_EQ(plane.fate == PlaneFate::active, plane.multiplier_m > 0.0);
      EXPECT_NEAR(
          plane.tool_distance_m,
          planes[plane.feature.object].normal.dot(tool) - planes[plane.feature.object].offset_m,
          kTolerance_m)
          << "row " << row;
    }
    for (std::size_t i = 0; i < planes.size(); ++i) {
      EXPECT_NEAR(multipliers[i], planes[i].multiplier_m, kTolerance_m)
          << "row " << row << " " << csv_.text(row, "category") << ", plane " << i;
    }
    ++checked;
  }
  EXPECT_GT(checked, 400);
}

// A hand strokes a ball of facets with friction.
class ExplainedStroke : public ::testing::Test {
 protected:
  static constexpr double kTool_m = 0.002;
  static constexpr int kTicks = 600;

  ExplainedStroke() {
    EXPECT_TRUE(world_->set_scene({&ball_.object(), 1}, {.tool_radius_m = kTool_m}));
    EXPECT_TRUE(other_->set_scene({&ball_.object(), 1}, {.tool_radius_m = kTool_m}));
  }

  static Vec3 tool_at(int tick) {
    const double angle = 0.01 * tick;
    const double r = 0.024 - std::min(4e-3, 1e-4 * tick);
    return {r * std::cos(angle), r * std::sin(angle), 0.2 * r * std::sin(3.0 * angle)};
  }

  Solid ball_{testing::icosphere(0.02, 4), rendering::Sides::one, kRough};
  std::unique_ptr<World> world_ = std::make_unique<World>();
  std::unique_ptr<World> other_ = std::make_unique<World>();
};

TEST_F(ExplainedStroke, FeelsTheSameAndItsMovesAreTheProxysPath) {
  Explainer explainer(kTool_m);
  std::size_t moves = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const ExplainedTick& explained = explain(explainer, *world_, tool_at(tick));
    rendering::ProxyPath path;
    const Touch touch = other_->touch({.p_W = tool_at(tick)}, &path);
    ASSERT_EQ(explained.touch.proxy_W, touch.proxy_W) << "tick " << tick;
    ASSERT_EQ(explained.touch.force_W, touch.force_W) << "tick " << tick;
    Vec3 at = path.points[0];
    std::size_t reached = 0;
    for (const ExplainedMove& move : explained.moves) {
      ASSERT_EQ(move.from_W, at) << "tick " << tick;
      at = move.to_W;
      reached += move.to_W != move.from_W && move.ending != MoveEnding::put_back ? 1U : 0U;
    }
    ASSERT_EQ(at, touch.proxy_W) << "tick " << tick;
    ASSERT_LE(reached, touch.sub_goals) << "tick " << tick;
    moves += reached;
  }
  EXPECT_GT(moves, std::size_t{kTicks} / 2);
}

TEST_F(ExplainedStroke, NamesTheFeatureThatIsTouched) {
  std::array<int, 4> seen{};
  Explainer explainer(kTool_m);
  for (int tick = 0; tick < kTicks; ++tick) {
    const ExplainedTick& explained = explain(explainer, *world_, tool_at(tick));
    ASSERT_EQ(explained.feature.has_value(),
              explained.touch.contact != rendering::ContactKind::none)
        << "tick " << tick;
    if (!explained.feature) {
      continue;
    }
    ASSERT_EQ(explained.feature->kind, explained.touch.contact) << "tick " << tick;
    ++seen[static_cast<std::size_t>(explained.feature->kind)];
    const rendering::MeshView& mesh = ball_.object().mesh;
    ASSERT_LT(explained.feature->face, mesh.triangles.size());
    if (explained.feature->kind == rendering::ContactKind::vertex) {
      const Vec3 vertex = to_vec3(mesh.vertices[explained.feature->vertex]);
      EXPECT_NEAR((vertex - explained.touch.proxy_W).norm(), kTool_m, 2e-6) << "tick " << tick;
    }
  }
  EXPECT_GT(seen[1], 0);
  EXPECT_GT(seen[2], 0);
}

// Pressed 2 mm into a plane and drawn along it, the proxy sticks until it lags by mu times the
// depth.
TEST(ExplainedFriction, ShowsTheCirclesAndTheTransition) {
  constexpr double kPressed_m = 0.002;
  constexpr double kStep_m = 1.1e-5;
  Object plane = object_of({.normal = Vec3::UnitZ(), .offset_m = 0.0, .multiplier_m = 0.0});
  plane.material = kRough;
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&plane, 1}, {.tool_radius_m = 0.0}));
  world->touch({.p_W = {0.0, 0.0, 0.001}});
  Explainer explainer(0.0);
  explain(explainer, *world, {0.0, 0.0, -kPressed_m});
  int slipped_at = 0;
  for (int step = 1; step <= 200; ++step) {
    const double x = kStep_m * step;
    const ExplainedTick& tick = explain(explainer, *world, {x, 0.0, -kPressed_m});
    ASSERT_FALSE(tick.moves.empty());
    const ExplainedMove& first = tick.moves.front();
    ASSERT_TRUE(first.circle.has_value());
    EXPECT_NEAR(first.circle->static_radius_m, 0.6 * kPressed_m, 1e-9);
    EXPECT_NEAR(first.circle->dynamic_radius_m, 0.4 * kPressed_m, 1e-9);
    if (slipped_at == 0) {
      EXPECT_NEAR(first.circle->lag_m, x, 1e-9) << "step " << step;
      EXPECT_EQ(first.friction == FrictionState::slip, x > 0.6 * kPressed_m) << "step " << step;
      EXPECT_EQ(first.friction_before, FrictionState::stick) << "step " << step;
    }
    if (slipped_at == 0 && first.friction == FrictionState::slip) {
      slipped_at = step;
    }
  }
  EXPECT_EQ(slipped_at, 110);
}

}  // namespace
}  // namespace tactus::host
