// Meshes whose vertices move. The oracles: the height of a sheet that is known in closed form,
// every triangle asked by brute force, and a rigid motion of all vertices together.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "rendering/tick_budget.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::kRough;
using testing::kSlippery;
using testing::Solid;

Object deforming(Object object) {
  object.deforms = true;
  return object;
}

constexpr double kCell_m = 0.01;

class DeformingTest : public ::testing::Test {
 protected:
  void take(const Solid& solid, double radius_m) {
    object_ = deforming(solid.object());
    ASSERT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = radius_m}));
    vertices_.assign(object_.mesh.vertices.begin(), object_.mesh.vertices.end());
  }

  // Moves every vertex to where `to` takes its place at rest, and remembers it.
  template <class Map>
  void deform(Map&& to) {
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
      const Vec3 p = to(to_vec3(object_.mesh.vertices[i]));
      ASSERT_TRUE(world_->move_vertex(0, i, p));
      vertices_[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()),
                      static_cast<float>(p.z())};
    }
  }

  // Returns the distance to the nearest of all triangles, at their places now, m.
  [[nodiscard]] double distance(const Vec3& p) const {
    double nearest = 1.0;
    for (const TriangleIndices& t : object_.mesh.triangles) {
      const Triangle triangle(to_vec3(vertices_[t[0]]), to_vec3(vertices_[t[1]]),
                              to_vec3(vertices_[t[2]]));
      nearest = std::min(nearest, triangle.nearest(p).distance);
    }
    return nearest;
  }

  Object object_;
  std::vector<Float3> vertices_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

TEST_F(DeformingTest, ASheetThatBulgesLiftsTheProxyOffAStillTool) {
  const Solid solid(testing::flat_sheet(kCell_m, 20), Sides::one, kSlippery);
  for (const double radius_m : {0.0, 0.002}) {
    take(solid, radius_m);
    const Vec3 tool(0.003, 0.001 + radius_m, 0.002);
    world_->touch({.p_W = tool});
    for (int tick = 0; tick < 300; ++tick) {
      const double top = 0.03 * std::sin(0.02 * tick);
      const auto height = [top](const Vec3& p) {
        return top / (1.0 + 400.0 * (p.x() * p.x() + p.z() * p.z()));
      };
      deform([&](const Vec3& p) { return Vec3(p.x(), height(p), p.z()); });
      const Touch touch = world_->touch({.p_W = tool});
      ASSERT_EQ(touch.flags, kTouchClean) << "tick " << tick;
      ASSERT_GE(distance(touch.proxy_W), radius_m + 0.2 * kMicron) << "tick " << tick;
      // The chords of the sheet lie below its vertices by less than a millimetre.
      ASSERT_GE(touch.proxy_W.y(), height(touch.proxy_W) - 0.0008) << "tick " << tick;
    }
  }
}

TEST_F(DeformingTest, AVertexTakesLongWaysInStepsOfTwoMillimetres) {
  const Solid solid(testing::flat_sheet(kCell_m, 2), Sides::one, kSlippery);
  take(solid, 0.0);
  world_->touch({.p_W = {0.0, 0.001, 0.0}});
  deform([](const Vec3& p) { return Vec3(p + Vec3(0.0, 0.01, 0.0)); });
  for (int tick = 1; tick <= 7; ++tick) {
    const Touch touch = world_->touch({.p_W = {0.0, -0.001, 0.0}});
    EXPECT_NEAR(touch.proxy_W.y(), std::min(0.01, 0.002 * tick), kMicron);
  }
}

TEST_F(DeformingTest, VerticesThatMoveTogetherFeelLikeAnObjectThatMoves) {
  const Solid ball(testing::bumpy_sphere(0.05, 3, 0.05), Sides::one, kRough);
  for (const double radius_m : {0.0, 0.002}) {
    take(ball, radius_m);
    Object rigid = ball.object();
    rigid.moves = true;
    const auto other = std::make_unique<World>();
    ASSERT_TRUE(other->set_scene({&rigid, 1}, {.tool_radius_m = radius_m}));
    for (int tick = 0; tick < 1000; ++tick) {
      const double t = 0.001 * tick;
      // Steps that floats hold exactly.
      const Vec3 shift(std::ldexp(std::floor(std::ldexp(0.1 * std::sin(7.0 * t), 16)), -16), 0, 0);
      deform([&](const Vec3& p) { return Vec3(p + shift); });
      other->set_pose(0, {.translation = shift}, {});
      const double around = 1.3 * t;
      const Vec3 tool = shift + (0.05 + radius_m + 0.006 * std::cos(9.0 * t)) *
                                    Vec3(std::cos(around), 0.0, std::sin(around));
      const Touch a = world_->touch({.p_W = tool});
      const Touch b = other->touch({.p_W = tool});
      // Rounding decides in how many moves a slip ends, and so where in its cone it sticks.
      ASSERT_LE((a.proxy_W - b.proxy_W).norm(), 30 * kMicron) << "tick " << tick;
    }
  }
}

// A ball whose surface boils, a tool that wanders about it, in and out: the proxy never comes
// nearer to any triangle than its radius, and never inside.
TEST_F(DeformingTest, ABallThatBoilsNeverSwallowsTheProxy) {
  constexpr std::uint64_t kSeed = 17;
  const int ticks = testing::share_of(4000);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  const Solid ball(testing::icosphere(0.05, 3), Sides::one, kRough);
  for (const double radius_m : {0.0, 0.002}) {
    take(ball, radius_m);
    std::vector<double> phase(vertices_.size());
    std::ranges::generate(phase, [&] { return 6.28 * normal(random); });
    Vec3 wish(0.07, 0.0, 0.0);
    std::size_t touched = 0;
    for (int tick = 0; tick < ticks; ++tick) {
      std::size_t i = 0;
      deform([&](const Vec3& p) {
        return Vec3(p * (1.0 + 0.08 * std::sin(0.15 * tick + phase[i++])));
      });
      wish += 0.001 * Vec3(normal(random), normal(random), normal(random));
      wish *= std::min(1.0, 0.07 / wish.norm());
      const Touch touch = world_->touch({.p_W = wish});
      const bool pinched = (touch.flags & kTouchPinched) != 0;
      ASSERT_FALSE(pinched) << "seed 17, tick " << tick << ", radius " << radius_m;
      ASSERT_GE(distance(touch.proxy_W), radius_m + 0.2 * kMicron) << "seed 17, tick " << tick;
      ASSERT_GE(touch.proxy_W.norm(), 0.044 + radius_m) << "seed 17, tick " << tick;
      touched += touch.contact != ContactKind::none ? 1 : 0;
    }
    if (ticks >= 4000) {  // it begins in the air
      EXPECT_GT(touched, 500U);
    }
  }
}

TEST_F(DeformingTest, OnlyAMeshOfTheSharedProxyMayDeform) {
  const Solid ball(testing::icosphere(0.05, 2), Sides::one, kRough);
  Object object = deforming(ball.object());
  EXPECT_TRUE(world_->set_scene({&object, 1}, {}));
  EXPECT_FALSE(world_->move_vertex(0, 100'000, {}));
  EXPECT_FALSE(world_->move_vertex(1, 0, {}));
  EXPECT_FALSE(world_->move_vertex(0, 0, Vec3::Constant(std::nan(""))));
  object.method = ContactMethod::potential_field;
  EXPECT_FALSE(world_->set_scene({&object, 1}, {}));
  const Solid large(testing::icosphere(0.05, 5), Sides::one, kRough);
  object = deforming(large.object());
  EXPECT_FALSE(world_->set_scene({&object, 1}, {})) << "more vertices than there is room for";
}

TEST_F(DeformingTest, ASceneMovesAndWavesItsObjectsByItselfUntilTheOutsideTakesOver) {
  const Solid solid(testing::flat_sheet(kCell_m, 4), Sides::one, kSlippery);
  const Motion motion{.velocity_W = {0.0, 0.1, 0.0}, .wave_m = 0.003, .wave_Hz = 5.0};
  const std::vector<Float3> up(25, Float3{0.0F, 1.0F, 0.0F});
  object_ = deforming(solid.object());
  object_.motion = &motion;
  EXPECT_FALSE(world_->set_scene({&object_, 1}, {})) << "waves need normals";
  object_.vertex_normals = up;
  ASSERT_TRUE(world_->set_scene({&object_, 1}, {}));
  world_->set_tick(0.001);
  Touch touch;
  for (int tick = 0; tick < 250; ++tick) {
    touch = world_->touch({.p_W = {0.0, tick == 0 ? 0.001 : -0.001, 0.0}});
    const double t = 0.001 * tick;
    ASSERT_NEAR(touch.proxy_W.y(),
                tick == 0 ? 0.001 : 0.1 * t + 0.003 * std::sin(31.41592653589793 * t), 2 * kMicron)
        << "tick " << tick;
  }
  ASSERT_TRUE(world_->set_pose(0, {.translation = {0.0, 0.01, 0.0}}, {}));
  for (int tick = 0; tick < 10; ++tick) {
    touch = world_->touch({.p_W = {0.0, -0.001, 0.0}});
  }
  const double last = touch.proxy_W.y();
  EXPECT_EQ(world_->touch({.p_W = {0.0, -0.001, 0.0}}).proxy_W.y(), last);
}

// The cost units of a tick far from a sheet of 441 vertices that waves faster than vertices step,
// which takes the most: every step is cut, and every box is drawn anew.
TEST_F(DeformingTest, TheTicksBudgetPaysForWavesFirst) {
  const Motion wave{.wave_m = 0.02, .wave_Hz = 40.0, .wave_per_m = {10.0, 0.0, 0.0}};
  const Solid sheet(testing::flat_sheet(kCell_m, 20), Sides::two, kSlippery);
  object_ = deforming(sheet.object());
  object_.motion = &wave;
  const std::vector<Float3> up(object_.mesh.vertices.size(), Float3{0.0F, 1.0F, 0.0F});
  object_.vertex_normals = up;
  const WorldConfig config{.tool_radius_m = 0.002};
  ASSERT_TRUE(world_->set_scene({&object_, 1}, config));
  std::size_t most = 0;
  for (int tick = 0; tick < 100; ++tick) {
    world_->touch({.p_W = {0.0, 0.5, 0.0}});
    most = std::max(most, world_->spent_units());
  }
  const std::size_t standing = standing_units({&object_, 1}, config);
  EXPECT_GT(most, object_.mesh.vertices.size() / kVertexWavesPerUnit);
  EXPECT_LE(most, standing + kCostOfGathering) << "the tool looks about itself";
  EXPECT_LT(standing, most + most / 4) << "much more is said than a tick takes";
  // In contact a budget below that leaves nothing for the proxy, and the tick says so.
  world_->set_tick_budget(0.5 * instructions_of(standing));
  world_->touch({.p_W = {0.05, 0.006, 0.05}});
  const Touch touch = world_->touch({.p_W = {-0.05, -0.01, -0.05}});
  EXPECT_NE(touch.flags & kTouchIterationsExhausted, 0U);
  ASSERT_TRUE(world_->set_scene({}, config)) << "the wave and the normals end with this test";
}

}  // namespace
}  // namespace tactus::rendering
