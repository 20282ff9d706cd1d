// A picture of the scene's meshes from one side, pale enough to draw a path over.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// The two orthographic views of a run. World frame W: x right, y up, z toward the user.
enum class View : std::uint8_t {
  front,  // from +z: x to the right, y up
  side,   // from -x: z to the right, y up
};

// A point of the picture plane, m: to the right and up.
struct PlanePoint {
  double right = 0.0;
  double up = 0.0;
};

PlanePoint project(View view, const Vec3& p_W);
// Distance toward the viewer, m; larger is nearer.
double nearness(View view, const Vec3& p_W);

// A rectangle of the picture plane, m.
struct Window {
  PlanePoint lower{.right = 0.0, .up = 0.0};
  PlanePoint upper{.right = 0.0, .up = 0.0};
  bool empty = true;

  void include(const PlanePoint& point);
  [[nodiscard]] double width() const { return upper.right - lower.right; }
  [[nodiscard]] double height() const { return upper.up - lower.up; }
};

// The window that just holds every vertex.
Window bounds(View view, std::span<const rendering::Object> objects);

// Rows from the bottom up, `width` pixels each; 255 is white.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

// Hidden surfaces removed, softly lit from the viewer's upper left, anti-aliased; white where there
// is no mesh. Linear in the triangles and pixels: 75k triangles at 900 x 900 take about 30 ms.
GreyImage draw_silhouette(View view, const Window& window, int width, int height,
                          std::span<const rendering::Object> objects);

}  // namespace tactus::host
