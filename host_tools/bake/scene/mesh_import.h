// Reads a mesh file of any format that Assimp knows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rendering/objects/object.h"

namespace tactus::host {

// A mesh in the frame and the unit of its file.
struct ImportedMesh {
  std::vector<Vec3> vertices;
  std::vector<rendering::TriangleIndices> triangles;
  std::vector<rendering::CornerPlaces> corner_places;  // one a triangle; none if the file has
                                                       // no texture coordinates, or not for all
  std::uint32_t lines_and_points = 0;                  // primitives that have no surface, left out
};

// Returns all meshes of the file, at the places that the file's nodes give them, with polygons cut
// into triangles. Nothing is merged, mended or left out beside lines and points. Throws InputError
// that names the file, and the line in text formats: missing or unreadable file, unknown format,
// damaged content, vertex not finite, index out of range, polygon that cannot be cut, no triangle
// at all.
ImportedMesh import_mesh(const std::filesystem::path& path);

}  // namespace tactus::host
