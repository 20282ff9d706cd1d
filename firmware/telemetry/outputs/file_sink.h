// A file that grows at its end, with its length and the checksum of what was written. Not real
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/telemetry/outputs/crc32.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

// A file of that name that is there already. Links are never followed.
enum class IfThere : std::uint8_t {
  replace,  // a file is emptied, a character device written to
  refuse,   // EEXIST
};

class FileSink {
 public:
  // Makes the file. 0, or errno: EEXIST too for a pipe, a socket or a disk, ELOOP
  // where it is a link.
  int open(const char* path, IfThere if_there = IfThere::replace);

  // All of it or, where there is no more room, nothing: then `error` is set and everything after is
  // left out, so that the file ends where it was still whole.
  void write(std::span<const std::byte> bytes);
  // 0, or the errno of the first failure.
  int close();

  // Of what is written from now on.
  void restart_crc() { crc_ = {}; }
  [[nodiscard]] std::uint32_t crc() const { return crc_.value(); }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] int descriptor() const { return file_.get(); }
  [[nodiscard]] bool is_open() const { return file_.is_open(); }
  [[nodiscard]] int error() const { return error_; }

 private:
  hal::FileDescriptor file_;
  Crc32 crc_;
  std::uint64_t size_ = 0;
  int error_ = 0;
};

}  // namespace tactus::firmware
