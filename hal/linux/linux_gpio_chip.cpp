#include "hal/linux/linux_gpio_chip.h"

#include <dirent.h>

#include <cerrno>
#include <string>

namespace tactus::hal {

namespace {

constexpr int kKernelNotSupported = 524;  // ENOTSUPP, which should not leave the kernel but does

struct FreeChipInfo {
  void operator()(gpiod_chip_info* info) const { gpiod_chip_info_free(info); }
};
struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

Result<LinuxGpioChip> open_path(const std::string& path) {
  LinuxGpioChip chip(gpiod_chip_open(path.c_str()));
  if (chip != nullptr) {
    return chip;
  }
  // ENODEV means that there is a device, but it is no GPIO chip.
  return errno == ENODEV ? failure(ErrorCode::not_found, errno) : gpio_failure(errno);
}

bool has_label(gpiod_chip& chip, std::string_view label) {
  const std::unique_ptr<gpiod_chip_info, FreeChipInfo> info(gpiod_chip_get_info(&chip));
  return info != nullptr && label == gpiod_chip_info_get_label(info.get());
}

}  // namespace

std::unexpected<Error> gpio_failure(int errno_value) {
  switch (errno_value) {
    case ENODEV:
      return failure(ErrorCode::disconnected, errno_value);
    case EBUSY:
      return failure(ErrorCode::busy, errno_value);
    case E2BIG:
    case ENXIO:
    case EOPNOTSUPP:
    case ENOSYS:
    case EINVAL:
    case kKernelNotSupported:
      return failure(ErrorCode::not_supported, errno_value);
    case ENOENT:
    case ENOTTY:
      return failure(ErrorCode::not_found, errno_value);
    case EACCES:
    case EPERM:
      return failure(ErrorCode::not_permitted, errno_value);
    case ENOMEM:
      return failure(ErrorCode::no_memory, errno_value);
    default:
      return failure(ErrorCode::io, errno_value);
  }
}

Result<LinuxGpioChip> open_gpio_chip(std::string_view label_or_path) {
  if (label_or_path.contains('/')) {
    return open_path(std::string(label_or_path));
  }
  const std::unique_ptr<DIR, CloseFolder> folder(::opendir("/dev"));
  if (folder == nullptr) {
    return gpio_failure(errno);
  }
  LinuxGpioChip found;
  std::unexpected<Error> why = failure(ErrorCode::not_found);
  while (const dirent* entry = ::readdir(folder.get())) {
    const std::string_view name(entry->d_name);
    if (!name.starts_with("gpiochip")) {
      continue;
    }
    auto chip = open_path("/dev/" + std::string(name));
    if (!chip) {
      // A chip without permission may be the right one; one that is going away is skipped.
      if (chip.error().code == ErrorCode::not_permitted) {
        why = std::unexpected(chip.error());
      }
    } else if (has_label(**chip, label_or_path)) {
      if (found != nullptr) {
        return failure(ErrorCode::invalid_argument);
      }
      found = std::move(*chip);
    }
  }
  if (found == nullptr) {
    return why;
  }
  return found;
}

std::size_t line_count_of(gpiod_chip& chip) {
  const std::unique_ptr<gpiod_chip_info, FreeChipInfo> info(gpiod_chip_get_info(&chip));
  return info == nullptr ? 0 : gpiod_chip_info_get_num_lines(info.get());
}

}  // namespace tactus::hal
