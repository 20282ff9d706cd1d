#include "host_tools/benchmark/debian_bunny.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace tactus::host {

std::optional<std::filesystem::path> extract_debian_bunny(const std::filesystem::path& folder) {
  const std::string archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
  const std::string member = "data/meshes/bunny00.off";
  std::error_code error;
  if (!std::filesystem::exists(archive, error)) {
    return std::nullopt;
  }
  const std::string command =
      "tar -xzf '" + archive + "' -C '" + folder.string() + "' '" + member + "' 2>/dev/null";
  if (std::system(command.c_str()) != 0) {  // NOLINT(concurrency-mt-unsafe): one thread
    return std::nullopt;
  }
  return folder / member;
}

}  // namespace tactus::host
