// Tells which parts of lines a mesh hides from the viewer, by a depth buffer.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "host_tools/plot/silhouette.h"
#include "rendering/geometry/mesh.h"

namespace tactus::host {

// The depths of meshes as the viewer sees them. Points are in the frame of the picture: x to the
// right, y up, z toward the viewer.
class LineVisibility {
 public:
  // Covers the window with pixels x pixels.
  LineVisibility(const Window& window, int pixels);

  // Adds a mesh whose vertices are in the frame of the picture. The time is linear in triangles and
  // pixels.
  void add(std::span<const rendering::Float3> vertices,
           std::span<const rendering::TriangleIndices> triangles);

  // Returns true if the meshes hide the point. A point on the surface is not hidden, nor is one
  // within a pixel of an outline.
  [[nodiscard]] bool hides(const Vec3& p) const;
  // Returns the parts of the line from a to b that are not hidden.
  [[nodiscard]] std::vector<std::pair<Vec3, Vec3>> visible_parts(const Vec3& a,
                                                                 const Vec3& b) const;
  // Returns the length of a pixel.
  [[nodiscard]] double pixel() const { return pixel_; }

 private:
  void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

  Window window_;
  int pixels_;
  double pixel_;
  // The z of the nearest surface in each pixel, from the lowest row up.
  std::vector<double> depths_;
};

}  // namespace tactus::host
