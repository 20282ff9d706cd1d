// `tactus plot`: figures of a run.
#pragma once

#include <CLI/CLI.hpp>

namespace tactus::host {

void add_plot_verb(CLI::App& app);

}  // namespace tactus::host
