// A file of sysfs that is opened once and then read and written without another path lookup.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "hal/error.h"
#include "hal/linux/system.h"

namespace tactus::hal {

// Converts the errno of a sysfs call:
//   disconnected   ENODEV, ENXIO: the device behind the file is gone
//   not_found      ENOENT
//   not_permitted  EACCES, EPERM
//   not_supported  EINVAL, EOPNOTSUPP, ENOSYS, ERANGE: the driver refuses the value
//   busy           EBUSY
//   no_memory      ENOMEM
//   io             the rest
std::unexpected<Error> sysfs_failure(int errno_value);

// An open attribute. Ordinary files work too, so that a test or an emulator can imitate the
// kernel's folders. A write begins at the file's start and ends with a line feed; only the first
// line counts. The errors are those of sysfs_failure.
//
// Real time: read and write. Opening is not. One thread at a time.
class SysfsFile {
 public:
  // The access for which a file is opened.
  enum class Use : std::uint8_t { read, read_and_write, write };

  // Opens a file, after closing the previous one.
  Result<void> open(const std::string& path, Use use);
  // Closes the file, if it is open.
  void close() { descriptor_.reset(); }
  // Returns true between open() and close().
  [[nodiscard]] bool is_open() const { return descriptor_.is_open(); }

  // Reads the first line into `room` and returns it without its line feed. `room` must hold all of
  // it.
  Result<std::string_view> read_line(std::span<char> room) const;
  // Returns the first line as a non-negative decimal number, or `io` if it is not one.
  Result<std::uint64_t> read_number() const;

  // Write a text of at most 63 characters, or a decimal number, as the whole line. A longer text is
  // invalid_argument.
  Result<void> write(std::string_view line) const;
  Result<void> write_number(std::uint64_t number) const;

 private:
  FileDescriptor descriptor_;
};

}  // namespace tactus::hal
