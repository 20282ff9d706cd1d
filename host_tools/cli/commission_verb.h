// `tactus commission`: the guided check of a device before its first force.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_commission_verb(CLI::App& app);

}  // namespace tactus::host
