// Chooses the Debian packages that go to a board.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tactus::host {

// The packages of one build.
struct BoardPackages {
  std::filesystem::path tactus;
  std::filesystem::path tactusd;
};

// Returns the newest tactusd_VERSION_ARCHITECTURE.deb of `folder`, or of the folder with the
// architecture's name in it, and the package tactus of the same version beside it. Throws
// InputError that names the command that makes them.
BoardPackages choose_packages(const std::filesystem::path& folder, std::string_view architecture);

}  // namespace tactus::host
