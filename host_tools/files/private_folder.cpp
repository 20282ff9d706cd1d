#include "host_tools/files/private_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the system's folder for temporary files. Throws InputError if there is none.
std::filesystem::path temporary_place() {
  std::error_code failure;
  const std::filesystem::path place = std::filesystem::temp_directory_path(failure);
  if (failure) {
    throw InputError(fmt::format("TMPDIR names no folder for temporary files: {}; set it to one",
                                 failure.message()));
  }
  return place;
}

}  // namespace

PrivateFolder::PrivateFolder() : PrivateFolder(temporary_place()) {}

PrivateFolder::PrivateFolder(const std::filesystem::path& place) {
  std::string pattern = (place / "tactus-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw InputError(fmt::format(
        "{}: no folder can be made here: {}; for temporary files set TMPDIR to one that can be "
        "written",
        pattern, std::generic_category().message(errno)));
  }
  path_ = pattern;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace tactus::host
