// `tactus inspect`: what is in a scene image.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_inspect_verb(CLI::App& app);

}  // namespace tactus::host
