// Draws the scene's meshes from one side, pale enough to draw a path over. gnuplot itself would be
// slow at that.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// The two orthographic views of a run. The world frame has x right, y up and z toward the user.
enum class View : std::uint8_t {
  // The view from +z: x to the right, y up.
  front,
  // The view from -x: z to the right, y up.
  side,
};

// A point of the picture plane, m: to the right and up.
struct PlanePoint {
  double right = 0.0;
  double up = 0.0;
};

// Returns the point of the picture plane in front of which p_W lies.
PlanePoint project(View view, const Vec3& p_W);
// Returns the distance toward the viewer, m; a larger value is nearer.
double nearness(View view, const Vec3& p_W);

// A rectangle of the picture plane, m.
struct Window {
  // The lower left and the upper right corner; they mean nothing while `empty`.
  PlanePoint lower{.right = 0.0, .up = 0.0};
  PlanePoint upper{.right = 0.0, .up = 0.0};
  bool empty = true;

  // Grows the window to hold the point.
  void include(const PlanePoint& point);
  [[nodiscard]] double width() const { return upper.right - lower.right; }
  [[nodiscard]] double height() const { return upper.up - lower.up; }
};

// Returns the square about the middle of a window: its half width is a share of the window's larger
// side, or of `least` where that is more. In the window's unit.
Window square_about(const Window& tight, double share, double least);

// Returns the smallest window that holds every vertex.
Window bounds(View view, std::span<const rendering::Object> objects);

// A picture in grey: rows from the bottom up, `width` pixels each; 255 is white.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

// Returns the meshes with hidden surfaces removed, softly lit from the viewer's upper left and
// anti-aliased; white where there is no mesh. The time is linear in triangles and pixels: 75k
// triangles at 900 x 900 take about 30 ms.
GreyImage draw_silhouette(View view, const Window& window, int width, int height,
                          std::span<const rendering::Object> objects);

}  // namespace tactus::host
