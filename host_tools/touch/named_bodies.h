// The bodies of a scene with their names, for the files that have a row for each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/geometry/vector.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

struct NamedBody {
  // The name of the object as a field of a CSV file, and its number.
  std::string name;
  std::uint32_t object = 0;
  // The axes of the object as the scene gives it, in O.
  Mat3 axes_O;
};

// Returns the bodies in the order of the objects. Throws InputError if there is none; `option` is
// what the user then should leave out.
std::vector<NamedBody> named_bodies(const rendering::SceneImage& scene, std::string_view option);

}  // namespace tactus::host
