// A strip of the moving world: the bodies of a scene and the tools at several times of a run, from
// the front and from the side. `tactus plot --bodies` draws it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "host_tools/plot/bodies_data.h"
#include "host_tools/plot/run_data.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The content of a strip.
struct BodiesStrip {
  std::span<const rendering::Object> objects;
  // The frames of the run; the first one is where the objects are given.
  std::span<const BodiesFrame> frames;
  // The run of each tool, and the radius of all, m.
  std::span<const RunData> tools;
  double tool_radius_m = 0.0;
  // The number of pictures in a row, at equal distances of time.
  std::size_t columns = 6;
  std::string title;
};

// The least and the largest number of columns.
inline constexpr std::size_t kFewestColumns = 2;
inline constexpr std::size_t kMostColumns = 12;

// Draws the strip: tools as circles, with the force on the hand as an arrow. Throws InputError if
// gnuplot is missing or fails.
void draw_bodies_strip(const BodiesStrip& strip, const std::filesystem::path& picture);

}  // namespace tactus::host
