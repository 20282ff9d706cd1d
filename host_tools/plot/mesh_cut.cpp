#include "host_tools/plot/mesh_cut.h"

#include <cstddef>

namespace tactus::host {

std::vector<CutLine> cut_lines(const rendering::MeshView& mesh,
                               const std::function<double(const Vec3&)>& height) {
  std::vector<CutLine> lines;
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    CutLine line;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3 && count < line.size(); ++k) {
      const Vec3 a = rendering::to_vec3(mesh.vertices[triangle[k]]);
      const Vec3 b = rendering::to_vec3(mesh.vertices[triangle[(k + 1) % 3]]);
      const double from = height(a);
      const double to = height(b);
      if ((from < 0.0) != (to < 0.0)) {
        line.at(count++) = a + from / (from - to) * (b - a);
      }
    }
    if (count == line.size()) {
      lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace tactus::host
