// Reads MCAP files: any that hold uncompressed chunks or none, whole or cut off by a crash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

struct McapMessage {
  std::string_view topic;
  std::string_view schema;  // its name
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::span<const std::byte> data;
};

// Reads an MCAP file. All returned views point into `file`, which must outlive them.
class McapReader {
 public:
  // Throws InputError if it is no MCAP file.
  explicit McapReader(std::span<const std::byte> file);

  // The messages in the order of the file; empty at the end. Throws InputError at a chunk whose
  // checksum or inside is wrong, or that is compressed.
  std::optional<McapMessage> next();
  void rewind();

  // Returns true if the file ends without its end record. A part of a record at the end is ignored.
  [[nodiscard]] bool cut() const { return cut_; }

  // The metadata: by the name of its record, then by key.
  using Texts = std::map<std::string, std::string, std::less<>>;
  [[nodiscard]] const std::map<std::string, Texts, std::less<>>& metadata() const {
    return metadata_;
  }
  // The attachments by name, checked, those of the same name in the order of the file.
  using Attachments = std::map<std::string, std::vector<std::span<const std::byte>>, std::less<>>;
  [[nodiscard]] const Attachments& attachments() const { return attachments_; }

 private:
  struct Channel {
    std::string_view topic;
    std::uint16_t schema = 0;
  };
  // Records that follow each other: a chunk's, or a message outside of chunks.
  struct Segment {
    std::span<const std::byte> records;
    std::size_t offset = 0;  // in the file, for messages
    std::uint32_t crc = 0;   // 0: none
  };
  struct Record {
    std::uint8_t opcode = 0;
    std::span<const std::byte> content;
  };

  static std::optional<Record> take_record(std::span<const std::byte>& rest);
  void take_top_level(const Record& record, std::span<const std::byte> whole, std::size_t offset);
  void take_chunk(std::span<const std::byte> content, std::size_t offset);
  void take_metadata(std::span<const std::byte> content);
  void take_attachment(std::span<const std::byte> content, std::size_t offset);
  void take_schema(std::span<const std::byte> content);
  void take_channel(std::span<const std::byte> content);
  [[nodiscard]] McapMessage message(std::span<const std::byte> content) const;
  bool open_segment();

  std::vector<Segment> segments_;
  std::size_t next_segment_ = 0;
  std::span<const std::byte> rest_;  // of the open segment
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::uint16_t, std::string_view> schemas_;
  std::map<std::string, Texts, std::less<>> metadata_;
  Attachments attachments_;
  bool cut_ = true;
};

}  // namespace tactus::host
