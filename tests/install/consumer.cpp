// Presses a 2 mm fingertip 1 mm into a floor and expects the spring's force back.
#include <array>
#include <cmath>
#include <cstdio>

#include "rendering/world/world.h"

namespace rendering = tactus::rendering;

int main() {
  static const std::array<rendering::Float3, 4> corners{
      {{-0.1F, 0, -0.1F}, {-0.1F, 0, 0.1F}, {0.1F, 0, 0.1F}, {0.1F, 0, -0.1F}}};
  static const std::array<rendering::TriangleIndices, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
  static const std::array<rendering::BvhNode, 1> nodes{
      {{.lower = {-0.1F, 0, -0.1F}, .first = 0, .upper = {0.1F, 0, 0.1F}, .triangle_count = 2}}};
  const std::array<rendering::Object, 1> floor{
      {{.mesh = {.vertices = corners, .triangles = triangles, .nodes = nodes},
        .material = {.stiffness_N_per_m = 500.0}}}};

  static rendering::World world;
  if (!world.set_scene(floor, {.tool_radius_m = 0.002})) {
    std::puts("the scene was refused");
    return 1;
  }
  world.touch({.p_W = {0.01, 0.010, 0.02}});                                 // above the floor
  const rendering::Touch touch = world.touch({.p_W = {0.01, 0.001, 0.02}});  // 1 mm into it

  std::printf("force_y = %.6f N\n", touch.force_W.y());
  return std::abs(touch.force_W.y() - 0.5) < 1e-2 ? 0 : 1;
}
