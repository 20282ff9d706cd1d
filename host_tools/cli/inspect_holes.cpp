#include "host_tools/cli/inspect_holes.h"

#include <fmt/format.h>

#include "host_tools/plot/figures.h"

namespace tactus::host {

std::vector<OpenLoop> holes_of(const rendering::SceneImage& image, std::size_t index) {
  const rendering::MeshView& mesh = image.baked_mesh(index).mesh;
  const bool has_holes = image.objects()[index].surface == rendering::SurfaceKind::mesh &&
                         image.counters(index).open_edges != 0;
  return has_holes ? find_open_loops(mesh.vertices, mesh.triangles) : std::vector<OpenLoop>{};
}

void draw_holes(const rendering::SceneImage& image, const std::string& name,
                const std::filesystem::path& picture) {
  std::vector<HoleMark> marks;
  for (std::size_t i = 0; i < image.objects().size(); ++i) {
    const rendering::MeshView& mesh = image.baked_mesh(i).mesh;
    for (const OpenLoop& hole : holes_of(image, i)) {
      HoleMark& mark = marks.emplace_back(
          HoleMark{.rim_W = {}, .middle_W = hole.middle_W, .size_m = hole.size_m});
      for (const MeshCorner& at : hole.corners) {
        for (std::uint32_t k = 0; k < 2; ++k) {
          mark.rim_W.push_back(
              rendering::to_vec3(mesh.vertices[mesh.triangles[at.triangle][(at.corner + k) % 3]]));
        }
      }
    }
  }
  draw_holes_figure(image.objects(), marks,
                    fmt::format("{}: {} hole{}", name, marks.size(), marks.size() == 1 ? "" : "s"),
                    picture);
}

}  // namespace tactus::host
