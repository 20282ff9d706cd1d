#include "host_tools/cli/inspect_graph.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <span>

#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/graph/graph_picture.h"
#include "host_tools/graph/graph_source.h"
#include "host_tools/graph/graph_text.h"

namespace tactus::host {

void add_graph_options(CLI::App& verb, InspectGraphOptions& options) {
  CLI::Option* const graph =
      verb.add_flag("--graph", options.graph,
                    "Show the connection graph: faces, edges and vertices with their types; also "
                    "of a mesh file");
  verb.add_option("--dot", options.dot, "With --graph, write it into this file for Graphviz")
      ->needs(graph);
}

void inspect_graph(const InspectGraphOptions& options, const std::string& file,
                   const std::string& picture, bool json) {
  keep_inputs_safe({picture, options.dot}, {file});
  keep_images_safe(options.dot);
  const GraphSource source = read_graphs(file);
  if (!options.dot.empty()) {
    const std::string dot = graph_dot(source);
    write_file_atomically(options.dot, std::as_bytes(std::span(dot)));
  }
  if (!picture.empty()) {
    draw_graph_picture(source, picture);
  }
  fmt::print("{}", json ? graph_json(source) : graph_summary(source));
}

}  // namespace tactus::host
