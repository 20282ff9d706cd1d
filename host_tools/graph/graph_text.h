// Writes connection graphs as text: a summary, JSON, and Graphviz's DOT.
#pragma once

#include <string>

#include "host_tools/graph/graph_source.h"

namespace tactus::host {

// Returns the numbers of nodes, connections and corners by type, Euler's number, and the first
// features of each mesh.
std::string graph_summary(const GraphSource& source);

// Returns one JSON object in one line, with every feature and its planes. README.md has the words.
std::string graph_json(const GraphSource& source);

// Returns a directed graph in the DOT language: faces as boxes (f0), edges as ellipses (e0) and
// vertices as circles (v0), coloured by type; a face leads to its edges, an edge to its vertices.
// The names of the second mesh begin with m1_ and so on.
std::string graph_dot(const GraphSource& source);

}  // namespace tactus::host
