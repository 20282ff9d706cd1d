// A tool that begins in touch with a potential field feels nothing of it until it has left.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "rendering/state_archive.h"
#include "rendering/world/world.h"
#include "tests/support/connected_solid.h"
#include "tests/support/shapes.h"

namespace tactus::rendering {
namespace {

constexpr double kStartStiffness = 600.0;

Object field_of(PrimitiveKind kind, const Vec3& place_W, const std::array<double, 3>& dimensions) {
  Object object;
  object.surface = SurfaceKind::primitive;
  object.method = ContactMethod::potential_field;
  object.primitive.kind = kind;
  object.primitive.X_WO.translation = place_W;
  object.primitive.dimensions_m = dimensions;
  object.material.stiffness_N_per_m = kStartStiffness;
  return object;
}

Object field_of(const testing::ConnectedSolid& solid) {
  Object object;
  object.method = ContactMethod::potential_field;
  object.mesh = solid.mesh().mesh;
  object.neighbours = solid.mesh().neighbours;
  object.vertex_normals = solid.mesh().vertex_normals;
  object.material.stiffness_N_per_m = kStartStiffness;
  return object;
}

// Signed distance from a box or a ball along the axes, m, by the textbook.
double distance_of(const Object& object, const Vec3& p_W) {
  const Primitive& shape = object.primitive;
  const Vec3 p_O = p_W - shape.X_WO.translation;
  if (shape.kind == PrimitiveKind::sphere) {
    return p_O.norm() - shape.dimensions_m[0];
  }
  const Vec3 half(shape.dimensions_m[0], shape.dimensions_m[1], shape.dimensions_m[2]);
  const Vec3 out = p_O.cwiseAbs() - half;
  return out.cwiseMax(0.0).norm() + std::min(out.maxCoeff(), 0.0);
}

// Numbers for random scenes and paths.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double least, double most) {
    return std::uniform_real_distribution(least, most)(random_);
  }
  Vec3 within(double most) {
    const double x = between(-most, most);
    const double y = between(-most, most);
    return {x, y, between(-most, most)};
  }

 private:
  std::mt19937_64 random_;
};

std::array<Object, 4> random_heap(Dice& dice) {
  std::array<Object, 4> heap;
  for (std::size_t i = 0; i < heap.size(); ++i) {
    const double size = dice.between(0.004, 0.02);
    heap[i] = i % 2 == 0 ? field_of(PrimitiveKind::box, dice.within(0.02),
                                    {size, dice.between(0.002, 0.02), dice.between(0.004, 0.02)})
                         : field_of(PrimitiveKind::sphere, dice.within(0.02), {size});
  }
  return heap;
}

// The push of the fields that the tool has been clear of, N. `began_in` loses those that it is
// clear of.
double largest_push(std::span<const Object> heap, std::span<bool> began_in, const Vec3& p_W,
                    double radius_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < heap.size(); ++i) {
    const double depth = radius_m - distance_of(heap[i], p_W);
    began_in[i] = began_in[i] && depth > 0.0;
    sum += began_in[i] ? 0.0 : kStartStiffness * std::max(depth, 0.0);
  }
  return sum;
}

TEST(FieldStart, AToolFeelsNothingOfWhatItBeginsInUntilItHasLeft) {
  constexpr std::uint64_t kSeed = 7301;
  Dice dice(kSeed);
  const auto world = std::make_unique<World>();
  std::size_t starts = 0;
  std::size_t returns = 0;
  for (int scene = 0; scene < 300; ++scene) {
    const double radius_m = scene % 3 == 0 ? 0.0 : 0.002;
    const auto heap = random_heap(dice);
    ASSERT_TRUE(world->set_scene(heap, {.tool_radius_m = radius_m}));
    for (int start = 0; start < 6; ++start) {
      world->reset();
      std::array<bool, 4> began_in;
      began_in.fill(true);
      const Vec3 from_W = dice.within(0.025);
      const Vec3 direction_W = dice.within(1.0).normalized();
      std::size_t inside = 0;
      for (int tick = 0; tick < 200; ++tick) {
        // The tool moves out and back, and trembles.
        const double travel = 0.05 * std::sin(0.02 * tick);
        const Vec3 p_W = from_W + travel * direction_W + dice.within(1e-4);
        const double most_N = largest_push(heap, began_in, p_W, radius_m);
        const Touch touch = world->touch({.p_W = p_W});
        const auto left_out = static_cast<std::size_t>(std::ranges::count(began_in, true));
        inside = tick == 0 ? left_out : inside;
        starts += tick == 0 && inside > 0 ? 1 : 0;
        returns += left_out < inside && most_N > 0.0 ? 1 : 0;
        ASSERT_LE(touch.force_W.norm(), most_N + 1e-9) << "seed " << kSeed << ", scene " << scene;
        ASSERT_EQ((touch.flags & kTouchOverlap) != 0, left_out > 0) << "scene " << scene;
      }
    }
  }
  EXPECT_GT(starts, 300U);
  EXPECT_GT(returns, 1000U) << "or nothing was felt after leaving";
}

TEST(FieldStart, AFieldThatTheToolHasLeftPushesAsItAlwaysDoes) {
  const auto ball = field_of(PrimitiveKind::sphere, Vec3::Zero(), {0.02});
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002}));
  for (const double from : {0.001, 0.019, 0.0219}) {
    world->reset();
    for (double y = from; y < 0.022; y += 0.0001) {
      ASSERT_EQ(world->touch({.p_W = {0.0, y, 0.0}}).force_W, Vec3::Zero()) << from << " to " << y;
      ASSERT_EQ(world->stretch_m(0), 0.0);
    }
    EXPECT_EQ(world->touch({.p_W = {0.0, 0.0221, 0.0}}).flags, kTouchClean);
    EXPECT_NEAR(world->touch({.p_W = {0.0, 0.021, 0.0}}).force_W.y(), 0.001 * kStartStiffness,
                1e-9);
    EXPECT_NEAR(world->stretch_m(0), 0.001, 1e-12);
  }
}

TEST(FieldStart, AFieldThatTheToolLeavesInOneTickIsFeltAfterIt) {
  const auto ball = field_of(PrimitiveKind::sphere, Vec3::Zero(), {0.02});
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002}));
  EXPECT_EQ(world->touch({.p_W = Vec3::Zero()}).force_W, Vec3::Zero());
  for (int i = 0; i < 3; ++i) {
    world->touch({.p_W = {0.0, 0.5, 0.0}});
  }
  EXPECT_NEAR(world->touch({.p_W = {0.0, 0.021, 0.0}}).force_W.y(), 0.001 * kStartStiffness, 1e-9);
}

TEST(FieldStart, FeelsNothingOfAMeshThatItBeginsInUntilItHasLeft) {
  constexpr double kRadius_m = 0.002;
  const testing::ConnectedSolid solid(testing::box(Vec3::Constant(0.04)));
  const Object object = field_of(solid);
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = kRadius_m}));
  for (const double from : {0.0, 0.013, 0.0215}) {
    world->reset();
    for (double y = from; y < 0.0219; y += 0.0001) {
      ASSERT_EQ(world->touch({.p_W = {0.001, y, 0.002}}).force_W, Vec3::Zero()) << y;
    }
    world->touch({.p_W = {0.001, 0.0221, 0.002}});
    EXPECT_NEAR(world->touch({.p_W = {0.001, 0.021, 0.002}}).force_W.y(), 0.001 * kStartStiffness,
                1e-6);
  }
}

TEST(FieldStart, ANewSceneRoundTheToolIsNotFelt) {
  const auto far = field_of(PrimitiveKind::sphere, {0.5, 0.0, 0.0}, {0.02});
  const auto near = field_of(PrimitiveKind::box, Vec3::Zero(), {0.02, 0.02, 0.02});
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&far, 1}, {.tool_radius_m = 0.002}));
  world->touch({.p_W = {0.0, 0.015, 0.0}});
  ASSERT_TRUE(world->set_scene({&near, 1}, {.tool_radius_m = 0.002}));
  EXPECT_EQ(world->touch({.p_W = {0.0, 0.015, 0.0}}).force_W, Vec3::Zero());
  EXPECT_EQ(world->touch({.p_W = {0.0, 0.019, 0.0}}).force_W, Vec3::Zero());
}

// A field that moves over a tool that was outside is no beginning: it pushes.
TEST(FieldStart, AFieldThatComesOverTheToolPushesAndOneThatMovesWithItDoesNot) {
  auto ball = field_of(PrimitiveKind::sphere, Vec3::Zero(), {0.02});
  ball.moves = true;
  const auto world = std::make_unique<World>();
  const auto at = [&](double y) {
    world->set_pose(0, {.translation = {0.0, y, 0.0}}, {});
    return world->touch({.p_W = Vec3::Zero()}).force_W;
  };
  ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002}));
  EXPECT_EQ(at(0.005), Vec3::Zero());
  EXPECT_EQ(at(0.015), Vec3::Zero());
  EXPECT_EQ(at(0.025), Vec3::Zero());
  EXPECT_NEAR(at(0.021).y(), -0.001 * kStartStiffness, 1e-9);
}

TEST(FieldStart, EachToolHasABeginningOfItsOwn) {
  const auto ball = field_of(PrimitiveKind::sphere, Vec3::Zero(), {0.02});
  const auto world = std::make_unique<WorldOf<2>>();
  ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002, .tool_count = 2}));
  std::array<ToolState, 2> tools{{{.p_W = {0.0, 0.03, 0.0}}, {.p_W = {0.0, 0.021, 0.0}}}};
  std::array<Touch, 2> touches;
  world->touch(tools, touches);
  tools[0].p_W.y() = 0.021;
  world->touch(tools, touches);
  EXPECT_GT(touches[0].force_W.y(), 0.5);
  EXPECT_EQ(touches[1].force_W, Vec3::Zero());
}

TEST(FieldStart, WhatTheToolBeganInIsPartOfTheState) {
  const auto ball = field_of(PrimitiveKind::sphere, Vec3::Zero(), {0.02});
  const auto world = std::make_unique<World>();
  for (const bool began_in : {false, true}) {
    ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002}));
    world->touch({.p_W = {0.0, began_in ? 0.021 : 0.03, 0.0}});
    std::vector<std::byte> bytes(std::size_t{1} << 16U);
    auto writer = StateArchive::writer(bytes);
    world->transfer(writer);
    ASSERT_TRUE(writer.good());
    bytes.resize(writer.size());
    ASSERT_TRUE(world->set_scene({&ball, 1}, {.tool_radius_m = 0.002}));
    world->touch({.p_W = {0.0, began_in ? 0.03 : 0.021, 0.0}});
    auto reader = StateArchive::reader(bytes);
    world->transfer(reader);
    ASSERT_TRUE(reader.good() && reader.at_end());
    EXPECT_NEAR(world->touch({.p_W = {0.0, 0.021, 0.0}}).force_W.y(),
                began_in ? 0.0 : 0.001 * kStartStiffness, 1e-9);
  }
}

}  // namespace
}  // namespace tactus::rendering
