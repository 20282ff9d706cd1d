// A file that is written in pieces and takes its place only when it is complete. Recorders, CSV
// writers and the baker use it in the process `tactus`; atomic_file.h is the shorter form for one
// write.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "hal/linux/system.h"
#include "host_tools/files/output_place.h"

namespace tactus::host {

// Writes to a temporary file beside the one that the user named, and renames it at the end: a full
// disk, a fault or an interruption leaves the old file as it was. A pipe or terminal is written to
// directly.
class OutputFile {
 public:
  // Creates the temporary file, or opens the pipe. Throws InputError if output_place() refuses
  // `output` or the system cannot create the file.
  OutputFile(const std::filesystem::path& output, OutputKind kind);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  // Removes the temporary file unless commit() has put it in its place.
  ~OutputFile();

  // Returns the path of the temporary file, for libraries that open a file by name; the pipe itself
  // if the output is one.
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }

  // Appends bytes; a write that a signal interrupts is repeated. Throws InputError that names the
  // output and the system's reason.
  void write(std::span<const std::byte> bytes);
  // Makes the file durable (fsync) and renames it over the user's file, whose permissions it keeps.
  // Does nothing to a pipe. Throws InputError as write() does.
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
