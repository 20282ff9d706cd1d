// The motion of a scene's object: its keys moves, deforms and motion.
#pragma once

#include <optional>
#include <string_view>

#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/object.h"

namespace tactus::host {

struct MotionDescription {
  bool moves = false;    // the program that runs the world may give its pose
  bool deforms = false;  // and its vertices
  std::optional<rendering::Motion> motion = std::nullopt;  // by itself
};

// `rest` is where the object stands at the start: the pivot, unless the scene gives one. Throws
// InputError with the file and the line.
MotionDescription read_motion(const TomlSection& object, std::string_view file,
                              const ShapeDescription& shape, rendering::ContactMethod contact,
                              const Vec3& rest);

}  // namespace tactus::host
