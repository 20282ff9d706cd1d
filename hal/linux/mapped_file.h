// A file mapped whole, for images that are used in place. It is for tools that run once, because
// nobody may write to the file meanwhile. The controller copies its files instead (image_slot.h).
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace tactus::hal {

// A mapping that lives as long as the object. The bytes keep their addresses when the object is
// moved. One thread at a time; not real time.
class MappedFile {
 public:
  MappedFile() = default;
  MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  MappedFile& operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  // Maps the file. Call once. Returns 0 or errno; EINVAL for an empty file and for what is no
  // regular file.
  int open(const char* path);
  // Returns the file's bytes; empty before open().
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace tactus::hal
