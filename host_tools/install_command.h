// The command by which a user installs a Debian package. The tools print it and never run it.
#pragma once

#include <string>
#include <string_view>

namespace tactus::host {

// Returns the command for a package of the given name, as one line for a shell.
inline std::string install_command(std::string_view package) {
  return "sudo apt install " + std::string(package);
}

}  // namespace tactus::host
