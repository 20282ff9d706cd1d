#include "firmware/linux/tactusd/run_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>

#include "firmware/linux/commands/device_folders.h"

namespace tactus::firmware {
namespace {

const char* base_folder(const Options& options) {
  return options.run_dir != nullptr ? options.run_dir : kRunFolder;
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
    if (const int failed = make_device_folder(further.data(), status); failed != 0) {
      std::fprintf(stderr,
                   "tactusd: %s: cannot make the folder for the sockets of device %zu: %s\n",
                   further.data(), i + 1, std::strerror(failed));
      return false;
    }
  }
  return true;
}

bool name_devices(const Options& options) {
  std::array<std::string_view, rendering::kMaxTools> names{};
  for (std::size_t i = 0; i < options.device_count; ++i) {
    names[i] = device_name_of(options.devices[i]);
  }
  const char* const folder = base_folder(options);
  const int failed = link_device_names(folder, std::span(names).first(options.device_count));
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: %s/%s: cannot link the names of the devices: %s\n", folder,
                 kNamesFolder, std::strerror(failed));
  }
  return failed == 0;
}

}  // namespace tactus::firmware
