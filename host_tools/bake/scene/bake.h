// The whole way from scene.toml to the image that the controller maps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/image_writer.h"
#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

struct ObjectReport {
  std::string name;
  std::string mesh;  // file
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint32_t lines_and_points = 0;  // of the file, left out
  rendering::BakeCounters counters;
  std::uint64_t bytes = 0;
  double seconds = 0.0;
  std::vector<std::string> warnings;  // one line each, with the remedy
};

struct BakeReport {
  std::string image;  // file
  double tool_radius_m = 0.0;
  std::uint64_t bytes = 0;
  double seconds = 0.0;
  std::vector<ObjectReport> objects;
};

// Told what is being done at the start of each step: "bunny: building the hierarchy".
using Progress = std::function<void(std::string_view step)>;

// Reads scene and meshes, writes the image whole or not at all (an image that was there before
// stays after a failure). Throws InputError naming the file and the place.
BakeReport bake_file(const std::filesystem::path& scene, const std::filesystem::path& image,
                     const Progress& progress = {});

}  // namespace tactus::host
