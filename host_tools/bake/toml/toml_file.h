// TOML text to tables, with an error that names the line.
#pragma once

#include <toml++/toml.h>

#include <string_view>

namespace tactus::host {

// Throws InputError, "file:line: not valid TOML: ...".
toml::table parse_toml(std::string_view text, std::string_view file);

}  // namespace tactus::host
