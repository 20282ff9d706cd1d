#include "hal/linux/sysfs_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>

namespace tactus::hal {

std::unexpected<Error> sysfs_failure(int errno_value) {
  switch (errno_value) {
    case ENODEV:
    case ENXIO:
      return failure(ErrorCode::disconnected, errno_value);
    case ENOENT:
    case ENOTDIR:
      return failure(ErrorCode::not_found, errno_value);
    case EACCES:
    case EPERM:
      return failure(ErrorCode::not_permitted, errno_value);
    case EINVAL:
    case EOPNOTSUPP:
    case ENOSYS:
    case ERANGE:
      return failure(ErrorCode::not_supported, errno_value);
    case EBUSY:
      return failure(ErrorCode::busy, errno_value);
    case ENOMEM:
      return failure(ErrorCode::no_memory, errno_value);
    default:
      return failure(ErrorCode::io, errno_value);
  }
}

Result<void> SysfsFile::open(const std::string& path, Use use) {
  const int access = use == Use::read ? O_RDONLY : use == Use::write ? O_WRONLY : O_RDWR;
  descriptor_ = FileDescriptor(::open(path.c_str(), access | O_CLOEXEC));
  if (!descriptor_.is_open()) {
    return sysfs_failure(errno);
  }
  return {};
}

// Reads from the start, because the kernel updates an attribute only then.
Result<std::string_view> SysfsFile::read_line(std::span<char> room) const {
  const ssize_t length = ::pread(descriptor_.get(), room.data(), room.size(), 0);
  if (length < 0) {
    return sysfs_failure(errno);
  }
  const std::string_view text(room.data(), static_cast<std::size_t>(length));
  return text.substr(0, text.find('\n'));
}

Result<std::uint64_t> SysfsFile::read_number() const {
  std::array<char, 32> room;
  const auto line = read_line(room);
  if (!line) {
    return std::unexpected(line.error());
  }
  std::uint64_t number = 0;
  const char* end = line->data() + line->size();
  const auto [stop, error] = std::from_chars(line->data(), end, number);
  if (error != std::errc{} || stop != end) {
    return failure(ErrorCode::io);
  }
  return number;
}

Result<void> SysfsFile::write(std::string_view line) const {
  std::array<char, 64> text;
  if (line.size() >= text.size()) {
    return failure(ErrorCode::invalid_argument);
  }
  *std::ranges::copy(line, text.begin()).out = '\n';
  if (::pwrite(descriptor_.get(), text.data(), line.size() + 1, 0) < 0) {
    return sysfs_failure(errno);
  }
  return {};
}

Result<void> SysfsFile::write_number(std::uint64_t number) const {
  std::array<char, 24> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return write(std::string_view(text.data(), end));
}

}  // namespace tactus::hal
