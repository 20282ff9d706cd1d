// Bakes a scene: reads scene.toml, its meshes and pictures, and writes the one image that the
// controller maps. `tactus bake` calls it in its own process; the controller contains none of this
// code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/bake/scene/image_writer.h"
#include "host_tools/bake/scene/progress.h"
#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// The findings of baking for one object, for the report to the user.
struct ObjectReport {
  // The object's name in the image.
  std::string name;
  // The mesh file; empty for a primitive or a formula.
  std::string mesh;
  // Triangles and vertices in the image; for a primitive or a formula those of its picture.
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  // Lines and points of the mesh file, which have no surface and were left out.
  std::uint32_t lines_and_points = 0;
  // The numbers of vertices that cleaning merged, triangles that it dropped, and faulty edges that
  // it found.
  rendering::BakeCounters counters;
  // The size of the object's arrays in the image.
  std::uint64_t bytes = 0;
  // How long the object took.
  double seconds = 0.0;
  // One line each, with the remedy.
  std::vector<std::string> warnings;
};

// The report of a whole bake.
struct BakeReport {
  // The image file as the user named it.
  std::string image;
  // The radius of the tool that the image is for.
  double tool_radius_m = 0.0;
  // The size of the whole image.
  std::uint64_t bytes = 0;
  // How long the whole bake took.
  double seconds = 0.0;
  std::vector<ObjectReport> objects;
};

// A scene that is baked in memory.
struct BakedImage {
  // The image, for rendering::SceneImage::open.
  std::vector<std::byte> bytes;
  BakeReport report;
};

// Bakes a scene that has been read. `report.image` and the seconds of writing are left out. Throws
// InputError that names the file and the place in it.
BakedImage bake_scene(const SceneDescription& description, const Progress& progress = {});

// Bakes the file `scene` into the file `image`, which takes its place only when it is complete:
// after a failure an older image is still there. Throws InputError that names the file and the
// place in it.
BakeReport bake_file(const std::filesystem::path& scene, const std::filesystem::path& image,
                     const Progress& progress = {});

}  // namespace tactus::host
