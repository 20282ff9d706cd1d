// How a user installs a Debian package; the tools say it and never do it.
#pragma once

#include <string>
#include <string_view>

namespace tactus::host {

inline std::string install_command(std::string_view package) {
  return "sudo apt install " + std::string(package);
}

}  // namespace tactus::host
