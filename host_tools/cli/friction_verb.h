// `tactus friction`: a friction model on a motion, on a mass, or in an experiment.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_friction_verb(CLI::App& app);

}  // namespace tactus::host
