#include "hal/linux/image_slot.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace tactus::hal {
namespace {

constexpr FileError kNotRegular{.what = "is not a regular file; name an image from tactus bake"};
constexpr FileError kEmpty{.what = "is empty; bake it again"};
constexpr FileError kTooLarge{
    .what =
        "is larger than the memory for images; start with a larger --scene-memory, or "
        "simplify its meshes"};
constexpr FileError kCut{.what = "became shorter while it was read; send the command again"};

// Returns the size rounded up to whole memory pages.
std::size_t whole_pages(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return (bytes + page - 1) / page * page;
}

FileError cannot_read(int error) {
  return {.what = "cannot be read", .errno_value = error};
}

}  // namespace

FileError open_regular_file(const char* path, FileDescriptor& file, std::size_t& size) {
  // Opening some devices and pipes has an effect, so the kind is checked before and after.
  struct stat status{};
  if (::stat(path, &status) != 0) {
    return cannot_read(errno);
  }
  if (!S_ISREG(status.st_mode)) {
    return kNotRegular;
  }
  FileDescriptor opened(::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!opened.is_open() || ::fstat(opened.get(), &status) != 0) {
    return cannot_read(errno);
  }
  if (!S_ISREG(status.st_mode)) {
    return kNotRegular;
  }
  if (status.st_size <= 0) {
    return kEmpty;
  }
  // A 32-bit board has files that are larger than its memory.
  if (!std::in_range<std::size_t>(status.st_size)) {
    return cannot_read(EFBIG);
  }
  size = static_cast<std::size_t>(status.st_size);
  file = std::move(opened);
  return {};
}

ImageSlot::~ImageSlot() {
  if (!room_.empty()) {
    ::munmap(room_.data(), room_.size());
  }
}

int ImageSlot::reserve(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  void* const room =
      // The addresses are reserved without memory behind them: PROT_NONE pages cost nothing.
      ::mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) {
    return errno;
  }
  room_ = {static_cast<std::byte*>(room), size};
  return 0;
}

FileError ImageSlot::read(const char* path) {
  clear();
  FileDescriptor file;
  std::size_t size = 0;
  if (const FileError error = open_regular_file(path, file, size); error.is_error()) {
    return error;
  }
  if (size > room_.size()) {
    return kTooLarge;
  }
  const FileError error = copy(file.get(), size);
  if (error.is_error()) {
    clear();
  }
  return error;
}

FileError ImageSlot::copy(int file, std::size_t size) {
  const std::size_t pages = whole_pages(size);
  if (::mprotect(room_.data(), pages, PROT_READ | PROT_WRITE) != 0) {
    return cannot_read(errno);
  }
  committed_ = pages;
  // Without the right to lock memory this fails with ENOMEM or EPERM; become_real_time reports
  // that.
  (void)::mlock(room_.data(), pages);
  std::size_t have = 0;
  while (have < size) {
    const ssize_t got = ::read(file, room_.data() + have, size - have);
    if (got > 0) {
      have += static_cast<std::size_t>(got);
    } else if (got == 0) {
      return kCut;
    } else if (errno != EINTR) {
      return cannot_read(errno);
    }
  }
  // The bytes are checked once and used in place, so a stray write shall fail and not change them.
  (void)::mprotect(room_.data(), pages, PROT_READ);
  used_ = size;
  return {};
}

void ImageSlot::clear() {
  if (committed_ > 0) {
    (void)::munlock(room_.data(), committed_);
    (void)::madvise(room_.data(), committed_, MADV_DONTNEED);
    (void)::mprotect(room_.data(), committed_, PROT_NONE);
  }
  committed_ = 0;
  used_ = 0;
}

}  // namespace tactus::hal
