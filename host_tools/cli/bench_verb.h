// `tactus bench`: how long a tick takes.
#pragma once

#include <CLI/CLI.hpp>

namespace tactus::host {

void add_bench_verb(CLI::App& app);

}  // namespace tactus::host
