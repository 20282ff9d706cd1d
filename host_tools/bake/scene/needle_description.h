// Reads [tool.needle] and [object.tissue]: a needle, and what makes an object a layer that it
// pierces.
#pragma once

#include <optional>
#include <string_view>

#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/needle/tissue.h"

namespace tactus::host {

// Reads the table of the needle, if there is one. Throws InputError with the file and the line.
std::optional<rendering::Needle> read_needle(const TomlSection& tool, std::string_view file);

// Reads the table of an object's tissue, if there is one. Throws InputError with the file and the
// line, also for an object that a needle cannot pierce and for a scene without a needle.
std::optional<rendering::Tissue> read_tissue(const TomlSection& object, std::string_view file,
                                             const ShapeDescription& shape,
                                             const MotionDescription& motion,
                                             const std::optional<rendering::Needle>& needle);

}  // namespace tactus::host
