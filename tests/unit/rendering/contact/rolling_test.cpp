// The proxy rolls round edges and vertices and along creases. The oracle is the distance from the
// tool to the lines and points that hold the sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>

#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::Solid;

constexpr double kRollingTool_m = 0.002;
constexpr double kBox_m = 0.04;
constexpr int kJumps = 500;

// Tangent moves alone draw the sphere to its rest by the ratio of depth to radius a move: at half
// the radius, which is the least depth here, it takes twenty of them to get within a nanometre, and
// at nine tenths a hundred.
class RollingTest : public ::testing::Test {
 protected:
  void take(const Solid& solid, const Vec3& from) {
    ASSERT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = kRollingTool_m}));
    world_->touch({.p_W = from});
  }
  Touch jump(const Vec3& tool) {
    ProxyPath path;
    const Touch touch = world_->touch({.p_W = tool}, &path);
    most_moves_ = std::max(most_moves_, path.count - 1);
    return touch;
  }
  double between(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }

  std::unique_ptr<World> world_ = std::make_unique<World>();
  std::mt19937_64 random_{1};
  std::size_t most_moves_ = 0;  // of a tick
};

TEST_F(RollingTest, RoundAnEdgeInFewMoves) {
  const Solid box(testing::box(Vec3::Constant(kBox_m)), Sides::one, testing::kSlippery);
  constexpr double kEdge_m = 0.5 * kBox_m;
  take(box, {0.03, 0.03, 0.0});
  for (int k = 0; k < kJumps; ++k) {
    const double angle = between(0.7, 0.9);
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    const Vec3 edge{kEdge_m, kEdge_m, between(-0.001, 0.001)};
    const Touch t = jump(edge + between(0.1, 0.5) * kRollingTool_m * out);
    ASSERT_EQ(t.flags, kTouchClean) << "jump " << k;
    ASSERT_LE((t.proxy_W - edge - kRollingTool_m * out).norm(), kMicron) << "jump " << k;
  }
  EXPECT_LE(most_moves_, 8U);
}

TEST_F(RollingTest, RoundAVertexInFewMoves) {
  const Solid box(testing::box(Vec3::Constant(kBox_m)), Sides::one, testing::kSlippery);
  const Vec3 vertex = Vec3::Constant(0.5 * kBox_m);
  take(box, {0.03, 0.03, 0.03});
  for (int k = 0; k < kJumps; ++k) {
    const Vec3 out = Vec3{between(0.9, 1.1), between(0.9, 1.1), between(0.9, 1.1)}.normalized();
    const Touch t = jump(vertex + between(0.1, 0.5) * kRollingTool_m * out);
    ASSERT_EQ(t.flags, kTouchClean) << "jump " << k;
    ASSERT_LE((t.proxy_W - vertex - kRollingTool_m * out).norm(), kMicron) << "jump " << k;
  }
  EXPECT_LE(most_moves_, 8U);
}

// Aslant over an edge, with friction: where the sphere slips it comes to rest as soon as its pull
// along the surface is what friction holds.
TEST_F(RollingTest, OverARoughEdgeInFewMoves) {
  const Solid box(testing::box(Vec3::Constant(kBox_m)), Sides::one, testing::kRough);
  constexpr double kEdge_m = 0.5 * kBox_m;
  constexpr double kDynamic = testing::kRough.friction.coulomb;
  take(box, {0.03, 0.03, 0.0});
  int slips = 0;
  for (int k = 0; k < kJumps; ++k) {
    const double angle = between(0.3, 1.3);
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    const Vec3 edge{kEdge_m, kEdge_m, between(-0.002, 0.002)};
    const Touch t = jump(edge + between(-0.2, 0.8) * kRollingTool_m * out);
    ASSERT_EQ(t.flags, kTouchClean) << "jump " << k;
    if (t.friction == FrictionState::slip) {
      const double pressure = t.force_W.dot(t.normal_W);
      const double pull = (t.force_W - pressure * t.normal_W).norm();
      ASSERT_NEAR(pull / pressure, kDynamic, 0.005 * kDynamic) << "jump " << k;
      ++slips;
    }
  }
  EXPECT_GT(slips, kJumps / 4);
  EXPECT_LE(most_moves_, 12U);
}

// Two upright plates whose upper edges lie in the plane z = 0 and part at a right angle toward
// greater y: the sphere rests between them, and the lower the farther they are apart.
class Rails {
 public:
  [[nodiscard]] static Solid solid() {
    testing::Shape shape{.name = "rails", .closed = false};
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(shape.vertices.size());
      for (const double y : {-kHalfGap_m, kHalfGap_m}) {
        for (const double z : {0.0, -0.01}) {
          shape.vertices.push_back(to_float3({side * (kHalfGap_m + kSlope * y), y, z}));
        }
      }
      shape.triangles.push_back({first, first + 1, first + 2});
      shape.triangles.push_back({first + 1, first + 3, first + 2});
    }
    return {shape, Sides::two, testing::kSlippery};
  }
  // The sphere's centre where it rests on both, which is at x = 0.
  [[nodiscard]] static Vec3 rest(double y) {
    const double aside = (kHalfGap_m + kSlope * y) / std::hypot(1.0, kSlope);
    return {0.0, y, std::sqrt(kRollingTool_m * kRollingTool_m - aside * aside)};
  }

 private:
  static constexpr double kHalfGap_m = 0.001;
  static constexpr double kSlope = 1.0;
};

TEST_F(RollingTest, AlongTheCreaseOfTwoEdgesInFewMoves) {
  const Solid rails = Rails::solid();
  take(rails, {0.0, 0.0, 0.01});
  jump({0.0, 0.0, 0.001});
  for (int k = 0; k < kJumps; ++k) {
    const Vec3 tool{0.0, between(-3e-4, 3e-4), between(0.0, 0.001)};
    const Touch t = jump(tool);
    ASSERT_EQ(t.flags, kTouchClean) << "jump " << k;
    double least = std::numeric_limits<double>::infinity();
    for (double y = -0.0009; y < 0.0018; y += kMicron) {
      least = std::min(least, (Rails::rest(y) - tool).norm());
    }
    ASSERT_NEAR((t.proxy_W - tool).norm(), least, kMicron) << "jump " << k;
  }
  EXPECT_LE(most_moves_, 20U);
}

}  // namespace
}  // namespace tactus::rendering
