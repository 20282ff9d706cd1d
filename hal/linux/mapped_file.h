// A file mapped whole, for images that are used in place. The bytes stay where they are when it is
// moved. For tools that run once: the
// file must not be written to meanwhile. The controller copies what it uses (image_slot.h).
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

  // 0, or errno. Once.
  int open(const char* path);
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace tactus::hal
