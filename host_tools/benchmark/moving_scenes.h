// Scenes of objects that move or deform, as many as a world can hold, and of layers that a needle
// pierces, to measure what a tick of them takes.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/scene/image_writer.h"

namespace tactus::host {

// A scene with a path of the tool through it: its positions in every tick of 1 ms, m, world frame.
struct MovingScene {
  std::string name;
  BakedScene scene;
  std::vector<Vec3> path;
};

// Returns 64 balls of 5 mm radius that sway and turn in a cube of 34 mm, through one another and
// about a tool of 2 mm radius, which circles within 12 mm of the middle. They are meshes of
// 20 * 4^level triangles, and sway by up to 4 mm at 0.5 to 3 Hz, both times `speed`.
MovingScene swarm(const std::string& name, int level, double speed, std::size_t ticks);

// Returns eight sheets of 484 vertices and 0.1 m length in a pile, each of which waves by 5 mm at 1
// to 3.1 Hz. A tool of 2 mm radius goes up and down between them.
MovingScene sheets(std::size_t ticks);

// Returns a wall of bricks as bodies, four rows of a quarter of `bricks` each, which stand on a
// plane and on each other. A tool of 2 mm radius strokes along its top.
MovingScene wall(const std::string& name, std::size_t bricks, std::size_t ticks);

// Returns five layers of tissue, one nested in the other, that a needle pierces and leaves again
// and again at up to 0.15 m/s, with a sideways motion.
MovingScene layers(std::size_t ticks);

}  // namespace tactus::host
