// `tactus plot`: figures of a run.
#pragma once

namespace CLI {
class App;
}

namespace tactus::host {

void add_plot_verb(CLI::App& app);

}  // namespace tactus::host
