// The bake of a scene as the verbs show it: progress, warnings, and a table of the objects. `tactus
// bake` and `tactus demo` use it.
#pragma once

#include <filesystem>
#include <string_view>

#include "host_tools/bake/scene/bake.h"

namespace tactus::host {

// Bakes the file `scene` into the file `image`; on a terminal a line shows what has been going on
// for how long. Throws InputError.
BakeReport bake_with_progress(const std::filesystem::path& scene,
                              const std::filesystem::path& image);

// Prints the warnings of all objects on stderr, in the name of a verb.
void print_bake_warnings(std::string_view verb, const BakeReport& report);

// Prints a row for each object, and the image with its size, on stdout.
void print_bake_table(const BakeReport& report);

}  // namespace tactus::host
