// The verbs that speak with a running controller: `tactus enable`, `tactus set` and their like.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_remote_verbs(CLI::App& app);

// Leaves main with the exit code of a refusal, which has been told already.
struct Refused {};

}  // namespace tactus::host
