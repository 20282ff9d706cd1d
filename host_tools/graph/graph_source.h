// Reads the connection graphs of a baked scene, or of a mesh file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/graph/connection_graph.h"
#include "host_tools/mesh/triangle_mesh.h"

namespace tactus::host {

// A mesh and its graph.
struct GraphedMesh {
  std::string name;
  // The number of the object in its scene; 0 for a mesh file.
  std::uint32_t object = 0;
  // World frame, m, for a scene, or the object's own frame for one that moves; the file's frame and
  // unit for a mesh file.
  TriangleMesh mesh;
  ConnectionGraph graph;
};

// The graphs of one file.
struct GraphSource {
  std::string file;
  bool is_scene = false;
  // At least one.
  std::vector<GraphedMesh> meshes;
  // The things that the file has beside its meshes, one line each.
  std::vector<std::string> notes;
};

// Reads a scene image or a mesh file of any format that `tactus bake` reads. The vertices of a mesh
// file that are at the same place become one, and triangles without area are dropped; the order
// stays that of the file. Throws InputError that names the file if it cannot be read, or has no
// mesh with a triangle.
GraphSource read_graphs(const std::filesystem::path& file);

// Returns the graphs of a scene's meshes; of none if all its objects are formulas and primitives.
// Throws InputError that names the file if it cannot be read.
std::vector<GraphedMesh> read_scene_graphs(const std::filesystem::path& scene);

}  // namespace tactus::host
