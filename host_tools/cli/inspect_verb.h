// `tactus inspect`: what is in a scene image.
#pragma once

#include <CLI/CLI.hpp>

namespace tactus::host {

void add_inspect_verb(CLI::App& app);

}  // namespace tactus::host
