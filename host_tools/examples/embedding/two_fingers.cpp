// Two fingertips in a world of a program's own: one presses a plate that the program lifts, the
// other a sheet in which the program raises a vertex.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>

#include "rendering/world/world.h"

namespace {

namespace rendering = tactus::rendering;
using tactus::Vec3;

constexpr double kRadius_m = 0.002;  // of a fingertip
constexpr double kDepth_m = 0.001;   // to which each of them presses
constexpr double kStiffness_N_per_m = 500.0;
constexpr double kRise_m = 0.001;
constexpr double kTick_s = 0.001;

// A square of 100 mm in y = 0 about (middle_x_m, 0, 0), its front upward, in four triangles that
// meet in its middle.
struct Square {
  explicit Square(float middle_x_m)
      : corners{{{middle_x_m, 0, 0},
                 {middle_x_m - 0.05F, 0, -0.05F},
                 {middle_x_m - 0.05F, 0, 0.05F},
                 {middle_x_m + 0.05F, 0, 0.05F},
                 {middle_x_m + 0.05F, 0, -0.05F}}},
        nodes{{{.lower = corners[1], .first = 0, .upper = corners[3], .triangle_count = 4}}} {}

  [[nodiscard]] rendering::Object object() const {
    return {.mesh = {.vertices = corners, .triangles = triangles, .nodes = nodes},
            .material = {.stiffness_N_per_m = kStiffness_N_per_m}};
  }

  std::array<rendering::Float3, 5> corners;
  std::array<rendering::TriangleIndices, 4> triangles{{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  std::array<rendering::BvhNode, 1> nodes;
};

// Returns true if both forces are as expected, within 1 %, and prints them.
bool report(const char* event, std::span<const rendering::Touch, 2> touches,
            const std::array<double, 2>& expected_N) {
  std::printf("%-22s plate %.4f N, sheet %.4f N\n", event, touches[0].force_W.y(),
              touches[1].force_W.y());
  return std::abs(touches[0].force_W.y() - expected_N[0]) < 0.01 * expected_N[0] &&
         std::abs(touches[1].force_W.y() - expected_N[1]) < 0.01 * expected_N[1];
}

}  // namespace

int main() {
  static const Square plate(-0.06F);
  static const Square sheet(0.06F);
  static std::array<rendering::Object, 2> objects{{plate.object(), sheet.object()}};
  objects[0].moves = true;    // set_pose may move it
  objects[1].deforms = true;  // move_vertex may move its vertices

  static rendering::WorldOf<2> world;
  if (!world.set_scene(objects, {.tool_radius_m = kRadius_m, .tool_count = 2}) ||
      !world.set_tick(kTick_s)) {
    std::puts("the scene was refused");
    return 1;
  }

  // Fingertips that begin outside feel what they touch from then on.
  std::array<rendering::ToolState, 2> fingers{
      {{.p_W = {-0.06, 0.010, 0.0}}, {.p_W = {0.06, 0.010, 0.0}}}};
  std::array<rendering::Touch, 2> touches;
  world.touch(fingers, touches);
  for (rendering::ToolState& finger : fingers) {
    finger.p_W.y() = kRadius_m - kDepth_m;
  }
  world.touch(fingers, touches);
  const double pressed_N = kStiffness_N_per_m * kDepth_m;
  bool good = report("both pressed:", touches, {pressed_N, pressed_N});

  // The plate goes up by 1 mm in 10 ms: a pose and a velocity for each tick.
  constexpr int kTicks = 10;
  for (int tick = 1; tick <= kTicks; ++tick) {
    const rendering::RigidPose pose{
        .translation = {0.0, kRise_m * static_cast<double>(tick) / kTicks, 0.0}};
    world.set_pose(0, pose, {.linear_W = {0.0, kRise_m / (kTicks * kTick_s), 0.0}});
    world.touch(fingers, touches);
  }
  const double raised_N = kStiffness_N_per_m * (kDepth_m + kRise_m);
  good = report("plate raised by 1 mm:", touches, {raised_N, pressed_N}) && good;

  // The sheet's middle goes up by 1 mm; it takes as many ticks as kMaxVertexStep_m asks for.
  world.move_vertex(1, 0, {0.06, kRise_m, 0.0});
  for (int tick = 0; tick < 100; ++tick) {
    world.touch(fingers, touches);
  }
  good = report("sheet raised by 1 mm:", touches, {raised_N, raised_N}) && good;
  return good ? 0 : 1;
}
