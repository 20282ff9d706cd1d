// Reads the keys of scene.toml that place something in the world.
#pragma once

#include <string_view>

#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/toml/toml_section.h"

namespace tactus::host {

// Reads longest_side_m, scale, position_m and rotation, as far as the section has them. Throws
// InputError with the file and the line.
Placement read_placement(const TomlSection& section, std::string_view file);

}  // namespace tactus::host
