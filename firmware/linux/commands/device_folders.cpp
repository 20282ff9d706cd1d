#include "firmware/linux/commands/device_folders.h"

#include <dirent.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <memory>

namespace tactus::firmware {
namespace {

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

// Removes the links of an earlier run from the folder.
void remove_links(DIR* folder) {
  // One thread starts a program, so nothing else reads this folder's entries.
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  while (const dirent* const entry = ::readdir(folder)) {
    if (entry->d_type == DT_LNK) {
      (void)::unlinkat(::dirfd(folder), std::begin(entry->d_name), 0);
    }
  }
}

bool can_be_file(std::string_view name) {
  return !name.empty() && name.size() <= NAME_MAX && name != "." && name != ".." &&
         !name.contains('/');
}

// Links the name to the folder of a device, 0 for the first. Returns 0 or errno.
int link_name(int folder, std::string_view name, std::size_t device) {
  std::array<char, NAME_MAX + 1> file{};
  std::ranges::copy(name, file.begin());
  std::array<char, 32> target{};
  if (device == 0) {
    std::snprintf(target.data(), target.size(), "..");
  } else {
    std::snprintf(target.data(), target.size(), "../%zu", device + 1);
  }
  return ::symlinkat(target.data(), folder, file.data()) == 0 ? 0 : errno;
}

}  // namespace

int make_device_folder(const char* folder, const struct stat& like) {
  constexpr mode_t kRights = 07777;
  if (::mkdir(folder, like.st_mode & kRights) != 0) {
    return errno == EEXIST ? 0 : errno;
  }
  // The owner has these rights if the folder's group is not changed.
  if (::chown(folder, static_cast<uid_t>(-1), like.st_gid) != 0 ||
      ::chmod(folder, like.st_mode & kRights) != 0) {
    return errno;
  }
  return 0;
}

int link_device_names(const char* run_dir, std::span<const std::string_view> names) {
  std::array<char, PATH_MAX> path{};
  std::snprintf(path.data(), path.size(), "%s/%s", run_dir, kNamesFolder);
  struct stat status{};
  if (::stat(run_dir, &status) != 0) {
    return errno;
  }
  if (const int failed = make_device_folder(path.data(), status); failed != 0) {
    return failed;
  }
  const std::unique_ptr<DIR, CloseFolder> folder(::opendir(path.data()));
  if (folder == nullptr) {
    return errno;
  }
  remove_links(folder.get());
  int failed = 0;
  for (std::size_t i = 0; i < names.size() && failed == 0; ++i) {
    if (can_be_file(names[i]) && std::ranges::count(names, names[i]) == 1) {
      failed = link_name(::dirfd(folder.get()), names[i], i);
    }
  }
  return failed;
}

std::string_view device_name_of(std::string_view path) {
  const std::string_view file = path.substr(path.rfind('/') + 1);
  return file.substr(0, file.rfind('.'));
}

}  // namespace tactus::firmware
