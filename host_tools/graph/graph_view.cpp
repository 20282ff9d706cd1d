#include "host_tools/graph/graph_view.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tactus::host {
namespace {

// The direction to the viewer in front: right of the user, and above.
Vec3 toward_viewer(GraphSide side) {
  const Vec3 front = Vec3(0.5, 0.42, 0.85).normalized();
  return side == GraphSide::front_right_above ? front : Vec3{-front};
}

}  // namespace

GraphView::GraphView(const GraphSource& source, GraphSide side, int pixels)
    : source_(source),
      right_(Vec3::UnitY().cross(toward_viewer(side)).normalized()),
      up_(toward_viewer(side).cross(right_)),
      toward_(toward_viewer(side)),
      pixels_(pixels),
      visibility_((turn_meshes(), window_), pixels) {
  for (std::size_t i = 0; i < source_.meshes.size(); ++i) {
    visibility_.add(vertices_[i], source_.meshes[i].mesh.triangles);
  }
}

void GraphView::turn_meshes() {
  constexpr double kMargin = 0.57;
  Window tight;
  for (const GraphedMesh& mesh : source_.meshes) {
    std::vector<rendering::Float3>& vertices = vertices_.emplace_back();
    vertices.reserve(mesh.mesh.vertices.size());
    for (const rendering::Float3& vertex : mesh.mesh.vertices) {
      const Vec3 p = turned(rendering::to_vec3(vertex));
      vertices.push_back(rendering::to_float3(p));
      tight.include({.right = p.x(), .up = p.y()});
    }
  }
  const double half = kMargin * std::max({tight.width(), tight.height(), 1e-9});
  const double right = 0.5 * (tight.lower.right + tight.upper.right);
  const double up = 0.5 * (tight.lower.up + tight.upper.up);
  window_ = {.lower = {.right = right - half, .up = up - half},
             .upper = {.right = right + half, .up = up + half},
             .empty = false};
}

// The silhouette's view from the front looks along the picture's own z.
GreyImage GraphView::image() const {
  std::vector<rendering::Object> objects;
  for (std::size_t i = 0; i < source_.meshes.size(); ++i) {
    objects.emplace_back().mesh = {
        .vertices = vertices_[i], .triangles = source_.meshes[i].mesh.triangles, .nodes = {}};
  }
  return draw_silhouette(View::front, window_, pixels_, pixels_, objects);
}

PlanePoint GraphView::pixel_of(const Vec3& p) const {
  return pixel_of_turned(turned(p));
}

PlanePoint GraphView::pixel_of_turned(const Vec3& p) const {
  return {.right = (p.x() - window_.lower.right) / visibility_.pixel(),
          .up = (p.y() - window_.lower.up) / visibility_.pixel()};
}

std::vector<PixelLine> GraphView::visible_parts(const Vec3& a, const Vec3& b) const {
  std::vector<PixelLine> lines;
  for (const auto& [from, to] : visibility_.visible_parts(turned(a), turned(b))) {
    lines.emplace_back(pixel_of_turned(from), pixel_of_turned(to));
  }
  return lines;
}

}  // namespace tactus::host
