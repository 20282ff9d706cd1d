// A mesh with polygons of any size, as a file declares it, and the triangles made of it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// A mesh in the frame and the unit of its file.
struct ImportedMesh {
  std::vector<Vec3> vertices;
  // Three indices into `vertices` each, counter-clockwise as seen from outside if the file follows
  // the custom.
  std::vector<rendering::TriangleIndices> triangles;
  // The texture places of each triangle's corners; empty if the file has texture coordinates for
  // none or for only some of the triangles.
  std::vector<rendering::CornerPlaces> corner_places;
  // Lines and points of the file, which have no surface and are left out.
  std::uint32_t lines_and_points = 0;
  // The findings for the user, one line each: `file:line: what; remedy`. Everything that the file
  // declares and the mesh lacks has one.
  std::vector<std::string> notes;
};

// The place of a corner in its texture: u to the right, v upwards.
using CornerPlace = std::array<float, 2>;

// The mesh while a file is read.
struct PolygonMesh {
  std::vector<Vec3> vertices;
  // The corners of all polygons, one polygon behind the other; `ends` has for each polygon the end
  // of its corners.
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> ends;
  // A place for every corner, or fewer if some polygons have none.
  std::vector<CornerPlace> places;
  // The same as of ImportedMesh.
  std::uint32_t lines_and_points = 0;
  std::vector<std::string> notes;

  // Appends a polygon with its texture places, or with none. One or two corners are a point or a
  // line, which is counted alone.
  void add(std::span<const std::uint32_t> polygon,
           std::span<const CornerPlace> polygon_places = {});
  // Appends a polygon of three corners or more with vertices of its own.
  void add_with_vertices(std::span<const Vec3> polygon);
};

// Returns the mesh with every polygon of n corners cut into n - 2 triangles. `file` begins the
// notes that this adds.
ImportedMesh cut_into_triangles(PolygonMesh&& mesh, const std::string& file);

// Turns every triangle around, so that the front becomes the back.
void turn_inside_out(ImportedMesh& mesh);

}  // namespace tactus::host
