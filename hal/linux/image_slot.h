// Room of a fixed size for one file that is used in place: the file is copied into it, so that no
// later write, truncation or unplugged disk reaches what was read. Whoever checks the bytes checks
// what runs.
//
// The addresses are reserved once and stay. Pages are had, and locked, for as much as the file
// needs; without the right to lock memory they are had all the same.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::hal {

// Words for the user; empty: it went well.
struct FileError {
  std::string_view what;
  int errno_value = 0;  // 0: the words say all

  [[nodiscard]] bool is_error() const { return !what.empty(); }
};

// One thread at a time. Not real time; reading `bytes` is.
class ImageSlot {
 public:
  ImageSlot() = default;
  ImageSlot(const ImageSlot&) = delete;
  ImageSlot& operator=(const ImageSlot&) = delete;
  ~ImageSlot();

  // Once, before read; `bytes` of address space. 0, or errno.
  int reserve(std::size_t bytes);

  // Copies the file in place of what was there. Never waits for another program: what is no regular
  // file is refused unopened. Refused too: an empty file, one larger than the slot, one that grew
  // shorter meanwhile. Time grows with the file, and with a slow disk.
  FileError read(const char* path);

  // Gives the pages back.
  void clear();

  [[nodiscard]] std::span<const std::byte> bytes() const { return room_.first(used_); }
  [[nodiscard]] std::size_t capacity() const { return room_.size(); }

 private:
  FileError copy(int file, std::size_t size);

  std::span<std::byte> room_;
  std::size_t committed_ = 0;
  std::size_t used_ = 0;
};

// Opens a regular file for reading, and neither waits nor opens if it is none.
FileError open_regular_file(const char* path, FileDescriptor& file, std::size_t& size);

}  // namespace tactus::hal
