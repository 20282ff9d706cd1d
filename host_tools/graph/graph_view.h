// A view of graphed meshes from an oblique direction, in pixels of a square panel.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "host_tools/graph/graph_source.h"
#include "host_tools/graph/line_visibility.h"
#include "host_tools/plot/silhouette.h"

namespace tactus::host {

// The directions from which the meshes are seen: opposite to each other, so that one of the two
// sees every face of a convex mesh.
enum class GraphSide : std::uint8_t { front_right_above, behind_left_below };

// A line of the picture, in pixels.
using PixelLine = std::pair<PlanePoint, PlanePoint>;

class GraphView {
 public:
  // The panel has pixels x pixels. `source` must outlive this.
  GraphView(const GraphSource& source, GraphSide side, int pixels);

  // Returns the meshes without their graphs, softly lit.
  [[nodiscard]] GreyImage image() const;
  // Returns the place of a point, in pixels from the lower left corner.
  [[nodiscard]] PlanePoint pixel_of(const Vec3& p) const;
  // Returns true if the meshes hide the point.
  [[nodiscard]] bool hides(const Vec3& p) const { return visibility_.hides(turned(p)); }
  // Returns the parts of the line between two points that the meshes do not hide.
  [[nodiscard]] std::vector<PixelLine> visible_parts(const Vec3& a, const Vec3& b) const;
  // Returns true if the front of a plane with this normal faces the viewer.
  [[nodiscard]] bool faces_viewer(const Vec3& normal) const { return turned(normal).z() > 0.0; }
  // Returns the width of the panel, in the unit of the meshes.
  [[nodiscard]] double width() const { return window_.width(); }

 private:
  // Returns a vector in the frame of the picture: x to the right, y up, z toward the viewer.
  [[nodiscard]] Vec3 turned(const Vec3& v) const {
    return {v.dot(right_), v.dot(up_), v.dot(toward_)};
  }
  [[nodiscard]] PlanePoint pixel_of_turned(const Vec3& p) const;
  // Turns the vertices of all meshes into the frame of the picture and finds the window.
  void turn_meshes();

  const GraphSource& source_;
  Vec3 right_;
  Vec3 up_;
  Vec3 toward_;
  int pixels_;
  std::vector<std::vector<rendering::Float3>> vertices_;
  Window window_;
  LineVisibility visibility_;
};

}  // namespace tactus::host
