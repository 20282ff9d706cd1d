// tactus replay: a recording lived once more, tick by tick, to the bit.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_replay_verb(CLI::App& app);

}  // namespace tactus::host
