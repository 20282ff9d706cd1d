// `tactus doctor`: whether this machine can run the controller on time.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_doctor_verb(CLI::App& app);

}  // namespace tactus::host
