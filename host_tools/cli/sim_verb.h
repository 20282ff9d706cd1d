// `tactus sim`: a simulated hand and device touch a scene through the real controller.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_sim_verb(CLI::App& app);

}  // namespace tactus::host
