// Reads a mesh file of any format that Assimp knows. The baker calls it.
#pragma once

#include <cstdint>
#include <filesystem>
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
};

// Returns all meshes of the file, at the places that the file's nodes give them, with polygons cut
// into triangles. Nothing is merged or mended, and nothing but lines and points is left out. Throws
// InputError that names the file, and the line for text formats: a missing or unreadable file, an
// unknown format, damaged content, a vertex that is not finite, an index out of range, a polygon
// that cannot be cut, or no triangle at all.
ImportedMesh import_mesh(const std::filesystem::path& path);

}  // namespace tactus::host
