#include "hal/linux/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>

#include "hal/linux/system.h"

namespace tactus::hal {

MappedFile::~MappedFile() {
  if (!bytes_.empty()) {
    // The interface of munmap takes what mmap gave, which was never written to.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  }
}

int MappedFile::open(const char* path) {
  const FileDescriptor file(::open(path, O_RDONLY | O_CLOEXEC));
  struct stat status{};
  if (!file.is_open() || fstat(file.get(), &status) != 0) {
    return errno;
  }
  if (!S_ISREG(status.st_mode) || status.st_size == 0) {
    return EINVAL;
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.get(), 0);
  if (mapped == MAP_FAILED) {
    return errno;
  }
  bytes_ = {static_cast<const std::byte*>(mapped), size};
  return 0;
}

}  // namespace tactus::hal
