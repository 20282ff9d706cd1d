// Finds the holes of a mesh: the loops of its open edges. The baker and `tactus inspect` tell of
// them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// A corner of a triangle, from which an edge of it runs to the next corner.
struct MeshCorner {
  std::uint32_t triangle = 0;
  std::uint32_t corner = 0;
};

// Open edges that run on from one to the next.
struct OpenLoop {
  // The corners at which the edges begin, in the order of the triangles' own turn: the mesh lies to
  // the left of the edges as seen from its front.
  std::vector<MeshCorner> corners;
  // False if the edges end at one that three or more triangles share, or that is wound
  // inconsistently.
  bool is_closed = true;
  // The middle of its box, world frame, m, and the diameter of the ball about that which holds it.
  Vec3 middle_W = Vec3::Zero();
  double size_m = 0.0;
};

// Returns all loops, the largest first. No triangle may repeat a vertex.
std::vector<OpenLoop> find_open_loops(std::span<const rendering::Float3> vertices,
                                      std::span<const rendering::TriangleIndices> triangles);

// Returns the loops' sizes and places for a message, the largest first and a few at most: "3 holes,
// 1.5 mm at (0.01, 0, 0.02) m, 1.2 mm at ..."; for no loops, an empty text.
std::string text_of_loops(std::span<const OpenLoop> loops);

// Returns the value of the key cap_holes_mm with which all loops are closed, a little above the
// largest size.
double cap_holes_mm_for(std::span<const OpenLoop> loops);

}  // namespace tactus::host
