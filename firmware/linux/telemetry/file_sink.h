// A file to which bytes are appended, with its length and the checksum of what was written. Not
// real time; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/telemetry/crc32.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

// The reaction of `open` to an existing file. Links are never followed.
enum class IfThere : std::uint8_t {
  // A file is emptied; a character device is written to.
  replace,
  // The error is EEXIST.
  refuse,
};

class FileSink {
 public:
  // Creates the file. Returns 0 or errno; EEXIST also for a pipe, a socket or a disk, and ELOOP for
  // a link.
  int open(const char* path, IfThere if_there = IfThere::replace);

  // Appends all bytes. On a failure, such as a full disk, it appends none of them, sets `error` and
  // ignores all later writes, so that the file ends after a complete record.
  void write(std::span<const std::byte> bytes);
  // Closes the file. Returns 0 or the errno of the first failure.
  int close();

  // Starts the checksum anew for the bytes written from now on.
  void restart_crc() { crc_ = {}; }
  // Returns the checksum of the bytes since restart_crc().
  [[nodiscard]] std::uint32_t crc() const { return crc_.value(); }
  // Returns the number of bytes written.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  // Returns the descriptor, which may also be read; -1 if the file is not open.
  [[nodiscard]] int descriptor() const { return file_.get(); }
  // Returns true between open() and close().
  [[nodiscard]] bool is_open() const { return file_.is_open(); }
  // Returns 0 or the errno of the first failure.
  [[nodiscard]] int error() const { return error_; }

 private:
  hal::FileDescriptor file_;
  Crc32 crc_;
  std::uint64_t size_ = 0;
  int error_ = 0;
};

}  // namespace tactus::firmware
