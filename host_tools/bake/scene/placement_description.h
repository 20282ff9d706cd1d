// The keys that say where something is.
#pragma once

#include <string_view>

#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/toml/toml_section.h"

namespace tactus::host {

// longest_side_m, scale, position_m and rotation, as far as the section has them.
Placement read_placement(const TomlSection& section, std::string_view file);

}  // namespace tactus::host
