// Reads how an object of the scene moves: its keys `moves`, `deforms` and `motion`.
#pragma once

#include <optional>
#include <string_view>

#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// How an object moves or deforms.
struct MotionDescription {
  // True if the program that runs the world may set the object's pose.
  bool moves = false;
  // True if it may set the object's vertices.
  bool deforms = false;
  // A motion that the object makes by itself; nothing if it stands still.
  std::optional<rendering::Motion> motion = std::nullopt;
};

// Reads the three keys. `rest` is where the object stands at the start, m: the pivot of a spin
// unless the scene names another. Throws InputError with the file and the line.
MotionDescription read_motion(const TomlSection& object, std::string_view file,
                              const ShapeDescription& shape, rendering::ContactMethod contact,
                              const Vec3& rest);

}  // namespace tactus::host
