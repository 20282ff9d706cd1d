// `tactus emulate`: plays a whole haptic device from the other side of its bus.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_emulate_verb(CLI::App& app);

}  // namespace tactus::host
