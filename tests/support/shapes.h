// Meshes for tests, made in memory: closed ones wound counter-clockwise seen from outside, open
// ones of either kind. Metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::testing {

struct Shape {
  std::string name;
  bool closed = true;  // bounds a solid: can be one-sided
  std::vector<rendering::Float3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
};

Shape icosphere(double radius_m, int subdivisions);
// The icosphere with every vertex moved along its ray by radius_factor(direction).
Shape bumpy_sphere(double radius_m, int subdivisions, double amplitude);
Shape box(const Vec3& size_m);
// A box whose faces are cut into `pieces` triangles with a width of about width_m: slivers.
Shape sliver_box(const Vec3& size_m, double width_m);
Shape torus(double major_m, double minor_m, int around, int across);
// A prism over a regular polygon; 3 sides make a wedge.
Shape prism(int sides, double radius_m, double height_m);
Shape cone(int sides, double radius_m, double height_m);
// A star-shaped prism: acute ridges and grooves.
Shape star(int points, double outer_m, double inner_m, double height_m);
// A solid block with a V groove of the given full angle along z.
Shape grooved_block(double angle_deg, double depth_m);
// A solid blade with an edge of the given angle along z, pointing up.
Shape blade(double angle_deg, double height_m);
// A solid block with a slot narrower or wider than the tool.
Shape slotted_block(double gap_m, double depth_m);
// A pit with sides inclined as a pyramid turned upside down in a block.
Shape pit(double half_width_m, double depth_m);

// Open or without an inside.
// A square of cells in y = 0 about the origin, two right triangles each, its front upward.
Shape flat_sheet(double cell_m, int cells);
Shape height_field(double size_m, int cells, double amplitude_m);
Shape moebius(double radius_m, double width_m, int segments);
Shape helicoid(double radius_m, double pitch_m, int segments);
Shape triangle_soup(std::uint64_t seed, int triangles, double size_m);
Shape open_tube(int sides, double radius_m, double height_m);
// A disc about the origin, its front upward, whose triangles all meet in its middle; its rim at
// y = rim_m, so that it is flat, a tip or a pit.
Shape disc(std::uint32_t sides, double radius_m, double rim_m);

Shape doubled(Shape shape);  // every triangle twice
Shape moved(Shape shape, const Vec3& offset_m);
Shape joined(Shape a, const Shape& b);  // side by side or through one another
Shape turned(Shape shape, const Vec3& axis, double angle_rad);

}  // namespace tactus::testing
