#include "firmware/linux/tactusd/run_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tactus::firmware {
namespace {

const char* base_folder(const Options& options) {
  return options.run_dir != nullptr ? options.run_dir : kRunFolder;
}

// Makes the folder of a further device, with the group and the rights of `base`. Returns 0 or
// errno.
int make_folder(const char* folder, const struct stat& base) {
  constexpr mode_t kRights = 07777;
  if (::mkdir(folder, base.st_mode & kRights) != 0) {
    return errno == EEXIST ? 0 : errno;
  }
  // The owner has these rights if the folder's group is not changed.
  if (::chown(folder, static_cast<uid_t>(-1), base.st_gid) != 0 ||
      ::chmod(folder, base.st_mode & kRights) != 0) {
    return errno;
  }
  return 0;
}

}  // namespace

FolderPath run_folder(const Options& options, std::size_t device) {
  FolderPath path{};
  if (device == 0) {
    std::snprintf(path.data(), path.size(), "%s", base_folder(options));
  } else {
    std::snprintf(path.data(), path.size(), "%s/%zu", base_folder(options), device + 1);
  }
  return path;
}

bool take_run_folder(const Options& options, ExclusiveUse& exclusive_use) {
  constexpr mode_t kOwnerAndGroup = 0750;
  const char* const folder = base_folder(options);
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
  if (!exclusive_use.of_run_folder(folder)) {
    return false;
  }
  for (std::size_t i = 1; i < options.device_count; ++i) {
    const FolderPath further = run_folder(options, i);
    if (const int failed = make_folder(further.data(), status); failed != 0) {
      std::fprintf(stderr,
                   "tactusd: %s: cannot make the folder for the sockets of device %zu: %s\n",
                   further.data(), i + 1, std::strerror(failed));
      return false;
    }
  }
  return true;
}

}  // namespace tactus::firmware
