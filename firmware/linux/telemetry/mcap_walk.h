// Reads the records of an MCAP file one after the other. Not real time; no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/linux/telemetry/file_sink.h"
#include "firmware/linux/telemetry/mcap_format.h"

namespace tactus::firmware::mcap {

// A record in the file: its place and its first bytes.
struct Found {
  // The number of a record's first bytes that are read: enough for all but its bulk.
  static constexpr std::size_t kFrontBytes = 512;

  Opcode opcode = Opcode::none;
  // The place of its opcode in the file.
  std::uint64_t offset = 0;
  // The length with the opcode and the length's own bytes.
  std::uint64_t length = 0;
  std::array<std::byte, kFrontBytes> front{};
  std::size_t front_bytes = 0;

  // Returns the first bytes of the content.
  [[nodiscard]] Unpacker content() const {
    return Unpacker(std::span(front).first(front_bytes).subspan(kRecordHeaderBytes));
  }
};

class Walk {
 public:
  // Begins at the file's first record. `end` is the place where the data section ends.
  explicit Walk(const FileSink& sink, std::uint64_t end)
      : descriptor_(sink.descriptor()), end_(end) {}

  // Reads the next record. Returns false at the end, and if the file cannot be read.
  bool next(Found& found);

 private:
  int descriptor_;
  std::uint64_t end_;
  std::uint64_t offset_ = kMagic.size();
};

}  // namespace tactus::firmware::mcap
