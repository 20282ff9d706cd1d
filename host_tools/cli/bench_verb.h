// `tactus bench`: how long a tick takes.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_bench_verb(CLI::App& app);

}  // namespace tactus::host
