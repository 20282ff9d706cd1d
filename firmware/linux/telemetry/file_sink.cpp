#include "firmware/linux/telemetry/file_sink.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace tactus::firmware {

namespace {

// Creates or opens the file. Returns -1 with errno if it exists and must not be emptied.
int make_file(const char* path, IfThere if_there) {
  constexpr mode_t kReadableByAll = 0644;
  const int exclusive = if_there == IfThere::refuse ? O_EXCL : 0;
  // open has only a variadic form. O_NONBLOCK keeps it from waiting at a pipe.
  hal::FileDescriptor file(
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
      ::open(path, O_CREAT | exclusive | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_RDWR | O_CLOEXEC,
             kReadableByAll));
  struct stat status{};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) {
    return -1;
  }
  const bool is_file = S_ISREG(status.st_mode);
  if (!is_file && !S_ISCHR(status.st_mode)) {
    errno = EEXIST;
    return -1;
  }
  // The returned descriptor is a copy, because `file` closes its own.
  return !is_file || ::ftruncate(file.get(), 0) == 0 ? ::fcntl(file.get(), F_DUPFD_CLOEXEC, 0) : -1;
}

}  // namespace

int FileSink::open(const char* path, IfThere if_there) {
  file_ = hal::FileDescriptor(make_file(path, if_there));
  crc_ = {};
  size_ = 0;
  error_ = file_.is_open() ? 0 : errno;
  return error_;
}

void FileSink::write(std::span<const std::byte> bytes) {
  if (error_ != 0) {
    return;
  }
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(file_.get(), bytes.data() + written, bytes.size() - written);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      error_ = count == 0 ? EIO : errno;
      // If this fails too, the file ends in an incomplete record, which readers skip.
      [[maybe_unused]] const int cut = ftruncate(file_.get(), static_cast<off_t>(size_));
      return;
    }
  }
  crc_.add(bytes);
  size_ += bytes.size();
}

int FileSink::close() {
  file_.reset();
  return error_;
}

}  // namespace tactus::firmware
