// If more triangles are within reach than the tick budget covers, the proxy moves on in the
// following ticks. The oracle is the smooth surface that the triangles approximate.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <tuple>

#include "rendering/world/world.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

// A disc about the origin, upward y, whose triangles all meet in its middle, as on the end of a
// turned part: flat, or a cone of 45 degrees that stands on it or is cut out of it.
enum class End : std::int8_t { flat = 0, tip = -1, pit = 1 };

testing::Shape disc(std::uint32_t sides, End end) {
  constexpr double kDisc_m = 0.02;
  return testing::disc(sides, kDisc_m, static_cast<int>(end) * kDisc_m);
}

// A half plane through the axis, in which the end is a line.
struct Section {
  Section(End end, const Vec3& p) {
    const double out = std::hypot(p.x(), p.z());
    if (out > 0.0) {
      outward = {p.x() / out, 0.0, p.z() / out};
    }
    const double slope = static_cast<int>(end);
    const double scale = std::hypot(1.0, slope);
    along = (outward + slope * Vec3::UnitY()) / scale;
    normal = (Vec3::UnitY() - slope * outward) / scale;
  }
  Vec3 outward = Vec3::UnitX();
  Vec3 along;
  Vec3 normal;
};

// A tip of a hundred sides lies that far within the cone; the others do not lie below theirs.
double within_m(End end) {
  return end == End::tip ? 3.0 * testing::kMicron : 0.0;
}

double height(End end, const Vec3& p) {
  const Section section(end, p);
  const double along = std::max(0.0, p.dot(section.along));
  return end == End::tip && p.dot(section.along) < 0.0
             ? p.norm()
             : (p - along * section.along).dot(section.normal);
}

// Returns where the sphere's centre should be: the point nearest to the tool among those a radius
// above the end. The tool is at most a radius deeper than that.
Vec3 nearest_above(End end, const Vec3& tool, double radius_m) {
  if (height(end, tool) >= radius_m) {
    return tool;
  }
  const Section section(end, tool);
  if (end == End::tip && tool.dot(section.along) < 0.0) {
    return radius_m * tool.normalized();
  }
  const Vec3 lowest = end == End::pit ? Vec3{std::numbers::sqrt2 * radius_m * Vec3::UnitY()}
                                      : Vec3{radius_m * section.normal};
  const double along = (tool - lowest).dot(section.along);
  return lowest + (end == End::pit ? std::max(0.0, along) : along) * section.along;
}

class DenseTest : public ::testing::Test {
 protected:
  // Notes how far the proxy of this tick is from its ideal place, and for how many ticks it has not
  // moved though it is far from there.
  void look(const Vec3& proxy, const Vec3& ideal) {
    constexpr double kFar_m = 0.1e-3;
    const double lag = (proxy - ideal).norm();
    most_lag_m_ = std::max(most_lag_m_, lag);
    still_ = proxy == last_ && lag > kFar_m ? still_ + 1 : 0;
    most_still_ = std::max(most_still_, still_);
    last_ = proxy;
  }

  void come_near(const Vec3& place) {
    for (int tick = 0; tick < 100; ++tick) {
      world_->touch({.p_W = place + 10.0 * testing::kMicron * Vec3::UnitY()});
    }
  }

  std::unique_ptr<World> world_ = std::make_unique<World>();
  Vec3 last_ = Vec3::Zero();
  int still_ = 0;
  int most_still_ = 0;
  double most_lag_m_ = 0.0;
};

class DiscTest : public DenseTest,
                 public ::testing::WithParamInterface<std::tuple<std::uint32_t, End, double>> {};

// Five strokes to and fro, or one and a half.
int ticks_of_strokes() {
  return std::max(1'500, testing::part_of(5'000));
}

// A tool that goes to and fro over the middle, as deep as that lets it.
Vec3 tool_at(int tick, double radius_m) {
  const double angle = 2.0 * std::numbers::pi * 1e-3 * tick;
  return {0.005 * std::cos(angle), radius_m - 0.001, 0.0003 * std::sin(0.7 * angle)};
}

TEST_P(DiscTest, TheProxyFollowsOverItsMiddleAndLeavesIt) {
  const auto [sides, end, radius_m] = GetParam();
  const Solid solid(disc(sides, end), Sides::one, testing::kSlippery);
  ASSERT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = radius_m}));
  come_near(nearest_above(end, tool_at(0, radius_m), radius_m));
  for (int tick = 0; tick < ticks_of_strokes(); ++tick) {
    const Vec3 tool = tool_at(tick, radius_m);
    const Vec3 proxy = world_->touch({.p_W = tool}).proxy_W;
    look(proxy, nearest_above(end, tool, radius_m));
    ASSERT_GE(height(end, proxy), radius_m - within_m(end)) << "tick " << tick;
  }
  EXPECT_LE(most_still_, 1);
  EXPECT_LE(most_lag_m_, end == End::tip ? 1.5e-3 : 1e-3);
  const Vec3 above{0.0, radius_m + 0.005, 0.0};
  const int most_ticks = end == End::pit ? 50 : 20;
  int ticks = 0;
  while (world_->touch({.p_W = above}).proxy_W != above) {
    ASSERT_LT(++ticks, most_ticks);
  }
}

// More triangles about one point than can be kept do not let the proxy slide, but they let it go.
TEST_F(DenseTest, TheProxyLeavesAPointOfMoreTrianglesThanItKeeps) {
  constexpr double kTool_m = 0.002;
  for (const End end : {End::flat, End::tip, End::pit}) {
    const Solid solid(disc(1'000, end), Sides::one, testing::kSlippery);
    ASSERT_TRUE(world_->set_scene({&solid.object(), 1}, {.tool_radius_m = kTool_m}));
    come_near(nearest_above(end, Vec3::Zero(), kTool_m));
    std::uint32_t flags = kTouchClean;
    for (int tick = 0; tick < std::max(100, testing::part_of(500)); ++tick) {
      flags |= world_->touch({.p_W = {0.0, 0.0005, 0.0}}).flags;
    }
    EXPECT_NE(flags & kTouchCandidatesOverflow, 0U);
    const Vec3 above{0.001, 0.008, 0.0};
    int ticks = 0;
    while (world_->touch({.p_W = above}).proxy_W != above) {
      ASSERT_LT(++ticks, 500) << static_cast<int>(end);
    }
  }
}

// It comes from below a tool that lies still beside its axis.
TEST_P(DiscTest, ThatRisesPushesTheProxyAndNeverSwallowsIt) {
  constexpr double kLowest_m = -0.006;
  constexpr double kTick_s = 1e-3;
  const auto [sides, end, radius_m] = GetParam();
  const Solid solid(disc(sides, end), Sides::one, testing::kSlippery);
  Object object = solid.object();
  object.moves = true;
  constexpr std::array kSpeeds_m_per_s{0.1, 1.0, 5.0, 0.01};
  const std::size_t speeds = std::max(std::size_t{3}, testing::part_of(kSpeeds_m_per_s.size()));
  for (const double speed : std::span(kSpeeds_m_per_s).first(speeds)) {
    ASSERT_TRUE(world_->set_scene({&object, 1}, {.tool_radius_m = radius_m}));
    for (double y = kLowest_m; y < -kLowest_m; y += speed * kTick_s) {
      ASSERT_TRUE(world_->set_pose(0, {.translation = {0.0, y, 0.0}}, {}));
      const Touch touch = world_->touch({.p_W = {0.0004, 0.0, 0.0003}});
      ASSERT_EQ(touch.flags & kTouchPinched, 0U) << speed << " m/s, " << y;
      ASSERT_GE(height(end, touch.proxy_W - Vec3{0.0, y, 0.0}), radius_m - within_m(end))
          << speed << " m/s, " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Flat, DiscTest,
                         ::testing::Combine(::testing::Values(100U, 180U, 200U, 500U),
                                            ::testing::Values(End::flat),
                                            ::testing::Values(0.0, 0.002)));
INSTANTIATE_TEST_SUITE_P(Pit, DiscTest,
                         ::testing::Combine(::testing::Values(100U, 180U, 200U, 500U),
                                            ::testing::Values(End::pit),
                                            ::testing::Values(0.0, 0.002)));
INSTANTIATE_TEST_SUITE_P(Tip, DiscTest,
                         ::testing::Combine(::testing::Values(100U, 180U, 200U, 500U),
                                            ::testing::Values(End::tip), ::testing::Values(0.002)));

// The same of a point that walks, which every triangle about a vertex may keep waiting. Where it
// has not met the surface the tool is not held out.
class WalkTest : public DenseTest,
                 public ::testing::WithParamInterface<std::tuple<std::uint32_t, End>> {};

TEST_P(WalkTest, ThePointFollowsOverItsMiddleAndLeavesIt) {
  const auto [sides, end] = GetParam();
  const testing::ConnectedSolid solid(disc(sides, end));
  const Object object{.method = ContactMethod::feature_walk,
                      .mesh = solid.mesh().mesh,
                      .neighbours = solid.mesh().neighbours,
                      .vertex_normals = solid.mesh().vertex_normals,
                      .material = testing::kSlippery};
  ASSERT_TRUE(world_->set_scene({&object, 1}, {}));
  come_near(nearest_above(end, tool_at(0, 0.0), 0.0));
  int off = 0;  // ticks in a row
  int most_off = 0;
  for (int tick = 0; tick < ticks_of_strokes(); ++tick) {
    const Vec3 tool = tool_at(tick, 0.0);
    const Vec3 proxy = world_->touch({.p_W = tool}).proxy_W;
    off = (proxy - nearest_above(end, tool, 0.0)).norm() > 0.2e-3 ? off + 1 : 0;
    most_off = std::max(most_off, off);
  }
  EXPECT_LE(most_off, 5);
  const Vec3 above{0.0, 0.005, 0.0};
  world_->touch({.p_W = above});
  world_->touch({.p_W = above});
  EXPECT_EQ(world_->touch({.p_W = above}).contact, ContactKind::none);
}

INSTANTIATE_TEST_SUITE_P(Ends, WalkTest,
                         ::testing::Combine(::testing::Values(100U, 200U, 500U, 2'000U),
                                            ::testing::Values(End::flat, End::pit, End::tip)));

// The tool goes to and fro over a ball that goes to and fro itself.
TEST_F(DenseTest, OnAFineBallThatMovesTheProxyGoesWithTheTool) {
  constexpr double kBall_m = 0.1;
  constexpr double kTool_m = 0.002;
  constexpr double kDepth_m = 0.001;
  const Solid solid(testing::icosphere(kBall_m, 7), Sides::one, testing::kSlippery);
  Object ball = solid.object();
  ball.moves = true;
  ASSERT_TRUE(world_->set_scene({&ball, 1}, {.tool_radius_m = kTool_m}));
  const auto out = [](int tick) {
    const double angle = 0.3 * std::sin(0.003 * tick);
    return Vec3{0.6 * std::sin(angle), 0.8 * std::sin(angle), std::cos(angle)};
  };
  world_->touch({.p_W = (kBall_m + kTool_m + kDepth_m) * out(0)});
  for (int tick = 0; tick < 1'500; ++tick) {
    const Vec3 middle{0.002 * std::sin(0.02 * tick), 0.0, 0.0};
    ASSERT_TRUE(world_->set_pose(0, {.translation = middle}, {}));
    const Touch touch = world_->touch({.p_W = middle + (kBall_m + kTool_m - kDepth_m) * out(tick)});
    look(touch.proxy_W - middle, (kBall_m + kTool_m) * out(tick));
  }
  EXPECT_LE(most_still_, 5);
  EXPECT_LE(most_lag_m_, 0.3e-3);
}

}  // namespace
}  // namespace tactus::rendering
