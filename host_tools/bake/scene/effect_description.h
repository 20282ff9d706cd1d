// Reads an [[effect]] of scene.toml: a force that fills the space, such as a spring, a field or a
// drag.
#pragma once

#include <cstddef>
#include <string_view>

#include "host_tools/bake/toml/toml_section.h"
#include "rendering/effects/effect.h"

namespace tactus::host {

// Returns the effect of a table. `index` is its number in the scene, from 0, for messages. Throws
// InputError with the file and the line.
rendering::Effect read_effect(const toml::table& table, std::size_t index, std::string_view file);

}  // namespace tactus::host
