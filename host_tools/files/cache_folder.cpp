#include "host_tools/files/cache_folder.h"

#include <cstdlib>

namespace tactus::host {

std::filesystem::path user_cache_folder() {
  // NOLINTBEGIN(concurrency-mt-unsafe): one thread, nothing sets the environment
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  // NOLINTEND(concurrency-mt-unsafe)
  if (cache != nullptr && *cache != '\0') {
    return std::filesystem::path(cache) / "tactus";
  }
  if (home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".cache" / "tactus";
  }
  return {};
}

}  // namespace tactus::host
