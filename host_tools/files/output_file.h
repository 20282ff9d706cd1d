// A file that is there whole or not at all, written in pieces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "hal/linux/system.h"
#include "host_tools/files/output_place.h"

namespace tactus::host {

// Writes to a file beside the one that the user named, and puts it in its place at the end: a full
// disk, a fault or an interruption leaves the old file as it was. A pipe is written to as it is.
class OutputFile {
 public:
  // Throws InputError: output_place refuses it, or it cannot be made.
  OutputFile(const std::filesystem::path& output, OutputKind kind);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  // Removes what was not committed.
  ~OutputFile();

  // The file that is being written; what a library opens by name.
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }

  // Throws InputError naming the output and the system's reason.
  void write(std::span<const std::byte> bytes);
  // Puts the file in its place. Throws InputError like write.
  void commit();

 private:
  [[noreturn]] void fail(int error);

  std::filesystem::path output_;  // as the user named it
  OutputPlace place_;
  std::filesystem::path partial_;
  hal::FileDescriptor file_;
  bool is_committed_ = false;
};

}  // namespace tactus::host
