#include "host_tools/benchmark/external_program.h"

#include <cstdlib>
#include <system_error>
#include <utility>

namespace tactus::host {

bool command_succeeds(const std::string& command) {
  const std::string silent = "{ " + command + "; } >/dev/null 2>&1 </dev/null";
  return std::system(silent.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): one thread
}

std::string shell_quoted(const std::filesystem::path& path) {
  std::string quoted = "'";
  for (const char c : path.string()) {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

FolderGuard::FolderGuard(std::filesystem::path path) : path_(std::move(path)) {
  std::filesystem::create_directories(path_);
}

FolderGuard::~FolderGuard() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tactus::host
