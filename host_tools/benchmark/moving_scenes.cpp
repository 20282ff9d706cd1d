#include "host_tools/benchmark/moving_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/bake/scene/body_bake.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/mesh/icosphere.h"
#include "host_tools/simulation/random.h"
#include "rendering/friction/friction_model.h"
#include "rendering/limits.h"
#include "rendering/needle/tissue.h"

namespace tactus::host {
namespace {

constexpr double kPathRadius_m = 0.002;
constexpr double kPathTick_s = 0.001;

// Returns a vector of three draws from -most to most.
Vec3 draw(SplitMix64& random, double most) {
  Vec3 drawn;
  for (double& along : drawn) {
    along = random.uniform(-most, most);
  }
  return drawn;
}

// Returns an object of the mesh with a motion of its own.
BakedObject moving_object(std::string name, const TriangleMesh& mesh,
                          const rendering::Motion& motion) {
  return {.name = std::move(name),
          .material = {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)},
          .mesh = bake_mesh(mesh),
          .motion = {.moves = true, .motion = motion}};
}

// Returns an object of the primitive, with the mesh that pictures show.
BakedObject shaped_object(std::string name, const rendering::Primitive& shape) {
  BakedObject object{.name = std::move(name)};
  object.shape = shape;
  object.mesh = bake_mesh(picture_of(object.shape, {}, object.sides).mesh);
  return object;
}

// Returns a level square of `side` times `side` vertices about the middle of the world, at a
// height.
TriangleMesh level_square(std::uint32_t side, double length_m, double height_m) {
  TriangleMesh mesh;
  const double last = side - 1;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      mesh.vertices.push_back(rendering::to_float3(
          {length_m * (i / last - 0.5), length_m * (j / last - 0.5), height_m}));
    }
  }
  for (std::uint32_t i = 0; i + 1 < side; ++i) {
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t a = i * side + j;
      const std::uint32_t b = a + side;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

}  // namespace

MovingScene swarm(const std::string& name, int level, double speed, std::size_t ticks) {
  constexpr std::uint64_t kSeed = 1;
  constexpr std::size_t kAlongEdge = 4;
  static_assert(kAlongEdge * kAlongEdge * kAlongEdge == rendering::kMaxMovers);
  constexpr double kSwarmStep_m = 0.008;
  constexpr double kSwarmJitter_m = 0.002;
  constexpr double kSwarmBall_m = 0.005;
  constexpr double kSway_m = 0.004;
  constexpr double kPath_m = 0.012;
  SplitMix64 random(kSeed);
  MovingScene swarm{.name = name, .scene = {.tool_radius_m = kPathRadius_m}};
  const TriangleMesh ball = icosphere(kSwarmBall_m, level);
  for (std::size_t i = 0; i < rendering::kMaxMovers; ++i) {
    const std::size_t row = i / kAlongEdge % kAlongEdge;
    const std::size_t layer = i / kAlongEdge / kAlongEdge;
    const auto x = static_cast<double>(i % kAlongEdge);
    const auto y = static_cast<double>(row);
    const auto z = static_cast<double>(layer);
    const Vec3 middle = Vec3::Constant(0.5 * static_cast<double>(kAlongEdge - 1));
    const Vec3 place = kSwarmStep_m * (Vec3{x, y, z} - middle) + draw(random, kSwarmJitter_m);
    TriangleMesh mesh = ball;
    for (rendering::Float3& vertex : mesh.vertices) {
      vertex = rendering::to_float3(rendering::to_vec3(vertex) + place);
    }
    rendering::Motion motion{.pivot_W = place};
    motion.sway_W = draw(random, kSway_m * speed);
    motion.sway_Hz = speed * random.uniform(0.5, 3.0);
    motion.spin_W = draw(random, 3.0 * speed);
    swarm.scene.objects.push_back(moving_object("ball " + std::to_string(i), mesh, motion));
  }
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = kPathTick_s * static_cast<double>(i);
    swarm.path.emplace_back(kPath_m *
                            Vec3{std::sin(2.6 * t + 1.2), std::sin(3.4 * t), std::cos(2.2 * t)});
  }
  return swarm;
}

MovingScene sheets(std::size_t ticks) {
  constexpr std::uint32_t kSide = 22;
  constexpr double kLength_m = 0.1;
  constexpr double kSheetsApart_m = 0.02;
  MovingScene pile{.name = "8 sheets", .scene = {.tool_radius_m = kPathRadius_m}};
  for (std::size_t k = 0; k < rendering::kMaxDeformables; ++k) {
    const auto number = static_cast<double>(k);
    const TriangleMesh sheet = level_square(kSide, kLength_m, kSheetsApart_m * (number - 3.5));
    const rendering::Motion motion{
        .wave_m = 0.005, .wave_Hz = 1.0 + 0.3 * number, .wave_per_m = {20.0, 7.0 + number, 0.0}};
    BakedObject object = moving_object("sheet " + std::to_string(k), sheet, motion);
    object.sides = rendering::Sides::two;
    object.motion.deforms = true;
    pile.scene.objects.push_back(std::move(object));
  }
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = kPathTick_s * static_cast<double>(i);
    pile.path.emplace_back(0.03 * std::sin(2.0 * t), 0.03 * std::cos(1.3 * t),
                           0.01 + 0.03 * std::cos(3.0 * t));
  }
  return pile;
}

MovingScene wall(const std::string& name, std::size_t bricks, std::size_t ticks) {
  constexpr std::size_t kRows = 4;
  constexpr double kBrick_kg = 0.05;
  const Vec3 half(0.02, 0.01, 0.01);
  // The gaps between bricks of a row: they are near each other, and their contacts count.
  constexpr double kBrickGap_m = 4e-4;
  MovingScene wall{.name = name, .scene = {.tool_radius_m = kPathRadius_m}};
  BakedObject floor = shaped_object("floor", {.kind = rendering::PrimitiveKind::plane});
  floor.material = {.friction = rendering::cone_friction(0.6, 0.4)};
  wall.scene.objects.push_back(std::move(floor));
  for (std::size_t i = 0; i < bricks; ++i) {
    const auto row = static_cast<double>(i % kRows);
    const std::size_t number = i / kRows;
    const auto column = static_cast<double>(number);
    // The bricks at the ends of the upper rows stand on one brick, with their middle over it.
    const double shift_m = i % 2 == 0 ? 0.0 : 0.5 * half.x();
    const Vec3 place(column * (2.0 * half.x() + kBrickGap_m) + shift_m,
                     half.y() * (2.0 * row + 1.0), 0.0);
    const rendering::Primitive box{.kind = rendering::PrimitiveKind::box,
                                   .X_WO = {.translation = place},
                                   .dimensions_m = {half.x(), half.y(), half.z()}};
    BakedObject brick = shaped_object("brick " + std::to_string(i), box);
    brick.material = {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)};
    brick.motion.moves = true;
    std::vector<std::string> warnings;
    brick.body = bake_body({.mass_kg = kBrick_kg}, brick.shape, {}, {}, warnings);
    wall.scene.objects.push_back(std::move(brick));
  }
  const std::size_t columns = bricks / kRows;
  const double length_m = 2.0 * half.x() * static_cast<double>(columns);
  const double top_m = 2.0 * half.y() * static_cast<double>(kRows) + kPathRadius_m;
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = kPathTick_s * static_cast<double>(i);
    // The tool comes from above: it would not feel a brick in which it began.
    const double above_m = 0.001 * std::max(0.0, 1.0 - 50.0 * t);
    wall.path.emplace_back(0.5 * length_m * (1.0 + 0.8 * std::sin(0.7 * t)),
                           top_m + above_m - 0.0004 * (1.0 + std::sin(2.0 * t)),
                           0.003 * std::sin(1.3 * t));
  }
  return wall;
}

MovingScene layers(std::size_t ticks) {
  constexpr int kLayers = 5;
  constexpr double kWide_m = 0.2;
  constexpr double kDeep_m = 0.15;
  constexpr double kThick_m = 0.01;
  constexpr double kPiercing_m = 0.065;
  MovingScene pierced{.name = "needle, 5 layers", .scene = {.tool_radius_m = 0.0}};
  pierced.scene.needle = rendering::Needle{.length_m = 0.09, .width_m = 1.2e-3};
  for (int i = 0; i < kLayers; ++i) {
    const double inset_m = kThick_m * i;
    const Vec3 half(0.5 * kWide_m - inset_m, 0.5 * (kDeep_m - inset_m), 0.5 * kWide_m - inset_m);
    // Every layer begins deeper than the one around it, and ends before it.
    const Vec3 middle(0.0, -0.5 * kDeep_m - 0.25 * inset_m, 0.0);
    BakedObject layer = shaped_object("layer " + std::to_string(i),
                                      {.kind = rendering::PrimitiveKind::box,
                                       .X_WO = {.translation = middle},
                                       .dimensions_m = {half.x(), half.y(), half.z()}});
    const rendering::ShaftFriction friction{
        .static_N_per_m = 30.0, .dynamic_N_per_m = 20.0, .viscous_Ns_per_m2 = 200.0};
    layer.tissue = rendering::Tissue{.stiffness_N_per_m = 200.0,
                                     .stiffness_N_per_m2 = 4e4,
                                     .puncture_force_N = 1.5,
                                     .cutting_force_N = 0.8,
                                     .toughness_J_per_m2 = 300.0,
                                     .in = friction,
                                     .out = friction,
                                     .lateral_stiffness_N_per_m2 = 5e3};
    pierced.scene.objects.push_back(std::move(layer));
  }
  for (std::size_t i = 0; i < ticks; ++i) {
    const double t = kPathTick_s * static_cast<double>(i);
    pierced.path.emplace_back(0.002 * std::sin(7.0 * t),
                              0.005 - 0.5 * kPiercing_m * (1.0 - std::cos(4.5 * t)),
                              0.002 * std::cos(5.0 * t));
  }
  return pierced;
}

}  // namespace tactus::host
