// `tactus inspect --graph`: shows the connection graph of meshes.
#pragma once

#include <string>

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// The options of --graph as the user gave them.
struct InspectGraphOptions {
  bool graph = false;
  std::string dot;
};

// Adds the options to the verb.
void add_graph_options(CLI::App& verb, InspectGraphOptions& options);

// Prints the graph of a scene or mesh file as text or JSON, and writes its DOT file and its picture
// if they are asked for. Throws InputError if the file has no graph or an output cannot be written.
void inspect_graph(const InspectGraphOptions& options, const std::string& file,
                   const std::string& picture, bool json);

}  // namespace tactus::host
