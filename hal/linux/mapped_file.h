// A file mapped whole, for images that are used in place.
#pragma once

#include <cstddef>
#include <span>

namespace tactus::hal {

class MappedFile {
 public:
  MappedFile() = default;
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
