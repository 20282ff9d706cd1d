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
namespace {

std::filesystem::path transitions_file(const std::string& output, const std::string& stem) {
  std::filesystem::path file(output);
  if (file.extension() == ".png" || file.extension() == ".svg") {
    return file;
  }
  // The other figures' names tell how the user's -o is meant.
  const std::filesystem::path force = figure_files(output.empty() ? "./" : output, stem).force;
  std::string name = force.filename().string();
  name.resize(name.size() - std::string_view("force.png").size());
  return force.parent_path() / (name + "transitions.png");
}

}  // namespace

void plot_transitions(const std::string& run, const std::string& scene, const std::string& output) {
  const std::filesystem::path csv(run);
  const std::filesystem::path picture = transitions_file(output, csv.stem().string());
  keep_inputs_safe({picture}, {csv, scene});
  const std::vector<GraphedMesh> meshes =
      scene.empty() ? std::vector<GraphedMesh>{} : read_scene_graphs(scene);
  const Transitions transitions = count_transitions(csv, meshes);
  const std::string name = csv.filename().string();
  if (picture.has_parent_path()) {
    std::filesystem::create_directories(picture.parent_path());
  }
  draw_transitions(transitions, fmt::format("{}: states of the contact", name), picture);
  fmt::print("{}{}\n", transitions_text(transitions, name), picture.string());
}

}  // namespace tactus::host
