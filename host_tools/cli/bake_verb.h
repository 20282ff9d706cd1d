// `tactus bake`: from scene.toml and meshes to a scene image.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_bake_verb(CLI::App& app);

}  // namespace tactus::host
