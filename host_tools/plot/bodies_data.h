// Reads the places of the bodies of a run, whether `tactus sim` or `tactus touch` wrote the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// The place of a body: its centre of mass, m, and the rotation of its axes; world frame.
struct BodyPlace {
  Vec3 center_W = Vec3::Zero();
  Mat3 axes_W = Mat3::Identity();
};

// All bodies at a time, in the order of their objects.
struct BodiesFrame {
  double t_s = 0.0;
  std::vector<BodyPlace> bodies;
};

// Reads a file of `tactus touch --bodies` or `tactus sim --bodies`, with a frame for each tick.
// Throws InputError, one line that names file, line and column, also if the rows are not those of
// so many bodies.
std::vector<BodiesFrame> read_bodies(const std::filesystem::path& file, std::size_t bodies);

}  // namespace tactus::host
