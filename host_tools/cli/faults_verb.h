// `tactus faults`: every fault and limit, its trigger, reaction and recovery.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_faults_verb(CLI::App& app);

}  // namespace tactus::host
