#include "hal/linux/mapped_file.h"

#include <sys/mman.h>

#include <cerrno>

#include "hal/linux/image_slot.h"
#include "hal/linux/system.h"

namespace tactus::hal {

MappedFile::~MappedFile() {
  if (!bytes_.empty()) {
    // munmap takes a non-const pointer; nothing is written.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  }
}

int MappedFile::open(const char* path) {
  FileDescriptor file;
  std::size_t size = 0;
  if (const FileError error = open_regular_file(path, file, size); error.is_error()) {
    return error.errno_value != 0 ? error.errno_value : EINVAL;
  }
  void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.get(), 0);
  if (mapped == MAP_FAILED) {
    return errno;
  }
  bytes_ = {static_cast<const std::byte*>(mapped), size};
  return 0;
}

}  // namespace tactus::hal
