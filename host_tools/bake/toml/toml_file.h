// Parses TOML text into tables.
#pragma once

#include <toml++/toml.h>

#include <string_view>

namespace tactus::host {

// Returns the root table; `file` names the text in errors. Throws InputError, "file:line: not valid
// TOML: ...".
toml::table parse_toml(std::string_view text, std::string_view file);

}  // namespace tactus::host
