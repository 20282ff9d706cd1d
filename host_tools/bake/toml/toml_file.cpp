#include "host_tools/bake/toml/toml_file.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"

namespace tactus::host {

toml::table parse_toml(std::string_view text, std::string_view file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}; correct the line", file,
                                 error.source().begin.line, error.description()));
  }
}

}  // namespace tactus::host
