// Writes a zip archive, with minizip, that takes its place when it is complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/files/output_file.h"

namespace tactus::host {

// An archive whose members are stored as they are, without compression, and without the time of
// day: the same content gives the same bytes. Members are written one after the other. Every
// function throws InputError that names the output if it cannot be written.
class ZipWriter {
 public:
  explicit ZipWriter(const std::filesystem::path& output);
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;
  // Removes the file unless commit() has put it in its place.
  ~ZipWriter();

  // Begins a member; it may have at most about `bytes` bytes, which decides the kind of its head.
  void begin(const std::string& name, std::uint64_t bytes);
  // Appends bytes, or those of a text, to the member.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  // Ends the member.
  void end();
  // Ends the archive and puts it in its place.
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path output_;
  OutputFile file_;
  // minizip's handle of the archive; null after its end.
  void* zip_ = nullptr;
};

}  // namespace tactus::host
