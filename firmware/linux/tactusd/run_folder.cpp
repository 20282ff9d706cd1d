#include "firmware/linux/tactusd/run_folder.h"

#include <sys/stat.h>

#include <cstdio>

namespace tactus::firmware {

const char* run_folder(const Options& options) {
  return options.run_dir != nullptr ? options.run_dir : kRunFolder;
}

bool take_run_folder(const Options& options, ExclusiveUse& exclusive_use) {
  constexpr mode_t kOwnerAndGroup = 0750;
  const char* const folder = run_folder(options);
  if (options.run_dir == nullptr) {
    (void)::mkdir(folder, kOwnerAndGroup);
  }
  struct stat status{};
  if (::stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)) {
    std::fprintf(stderr,
                 "tactusd: %s: there is no such folder for its sockets; make it, or name another "
                 "with --run-dir\n",
                 folder);
    return false;
  }
  return exclusive_use.of_run_folder(folder);
}

}  // namespace tactus::firmware
