// `tactus touch`: a tool path against a scene, without dynamics.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_touch_verb(CLI::App& app);

}  // namespace tactus::host
