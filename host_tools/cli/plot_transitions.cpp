#include "host_tools/cli/plot_transitions.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "host_tools/files/output_place.h"
#include "host_tools/graph/graph_source.h"
#include "host_tools/graph/transitions.h"
#include "host_tools/graph/transitions_figure.h"
#include "host_tools/plot/figures.h"

namespace tactus::host {
void plot_transitions(const std::string& run, const std::string& scene, const std::string& output,
                      PictureFormat format) {
  const std::filesystem::path csv(run);
  const std::filesystem::path picture =
      figure_file(output.empty() ? "./" : output, csv.stem().string(), "_transitions", format);
  keep_inputs_safe({picture}, {csv, scene});
  const std::vector<GraphedMesh> meshes =
      scene.empty() ? std::vector<GraphedMesh>{} : read_scene_graphs(scene);
  const Transitions transitions = count_transitions(csv, meshes);
  const std::string name = csv.filename().string();
  make_folder_of(picture);
  draw_transitions(transitions, fmt::format("{}: states of the contact", name), picture);
  fmt::print("{}{}\n", transitions_text(transitions, name), picture.string());
}

}  // namespace tactus::host
