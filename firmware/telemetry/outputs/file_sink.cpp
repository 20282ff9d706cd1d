#include "firmware/telemetry/outputs/file_sink.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace tactus::firmware {

int FileSink::open(const char* path) {
  constexpr mode_t kReadableByAll = 0644;
  // The variadic interface of open has no other form.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  file_ = hal::FileDescriptor(::open(path, O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, kReadableByAll));
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
      // If this fails too, the file ends in half a record, which readers leave out.
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
