// An [[effect]] of a scene.
#pragma once

#include <cstddef>
#include <string_view>

#include "host_tools/bake/toml/toml_section.h"
#include "rendering/effects/effect.h"

namespace tactus::host {

// `index` counts the scene's effects. Throws InputError with the file and the line.
rendering::Effect read_effect(const toml::table& table, std::size_t index, std::string_view file);

}  // namespace tactus::host
