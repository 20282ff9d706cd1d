// A file mapped whole, for images that are used in place. The bytes keep their addresses when the
// object is moved. It is for tools that run once, because nobody may write to the file meanwhile.
// The controller copies its files instead (image_slot.h).
#pragma once

#include <cstddef>
#include <span>
#include <utility>

namespace tactus::hal {

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

  // Maps the file. Call once. Returns 0 or errno.
  int open(const char* path);
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace tactus::hal
