// `tactus bake`: from scene.toml and meshes to a scene image.
#pragma once

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

void add_bake_verb(CLI::App& app);

}  // namespace tactus::host
