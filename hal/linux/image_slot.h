// A memory block of fixed size for one file that is used in place. The file is copied into it, so
// that no later write, truncation or unplugged disk changes the bytes that were checked.
//
// The addresses are reserved once and stay. Only the pages that the file needs are allocated, and
// they are locked in memory if the process has the right to it.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::hal {

// Why a file was not taken, as a text for the user; empty on success.
struct FileError {
  std::string_view what;
  // The errno behind the text; 0: the text is complete without it.
  int errno_value = 0;

  // Returns true if the file was not taken.
  [[nodiscard]] bool is_error() const { return !what.empty(); }
};

// A block for one file. One thread at a time. Not real time; reading `bytes` is.
class ImageSlot {
 public:
  ImageSlot() = default;
  ImageSlot(const ImageSlot&) = delete;
  ImageSlot& operator=(const ImageSlot&) = delete;
  ~ImageSlot();

  // Reserves `bytes` of address space. Call once, before read. Returns 0 or errno.
  int reserve(std::size_t bytes);

  // Replaces the content by a copy of the file. It refuses an empty file, one larger than the slot,
  // and one that became shorter meanwhile. It never waits for another program: anything but a
  // regular file is refused before it is opened. The time grows with the file's size.
  FileError read(const char* path);

  // Frees the pages.
  void clear();

  // Returns the copied file; empty before the first read and after clear().
  [[nodiscard]] std::span<const std::byte> bytes() const { return room_.first(used_); }
  // Returns the size of the largest file that fits, bytes.
  [[nodiscard]] std::size_t capacity() const { return room_.size(); }

 private:
  FileError copy(int file, std::size_t size);

  std::span<std::byte> room_;
  // The number of bytes whose pages are allocated, a multiple of the page size.
  std::size_t committed_ = 0;
  std::size_t used_ = 0;
};

// Opens a regular file for reading and gives its size, above 0. Refuses anything else, and an empty
// file. A device or a pipe is not opened, because that can have an effect or wait.
FileError open_regular_file(const char* path, FileDescriptor& file, std::size_t& size);

}  // namespace tactus::hal
