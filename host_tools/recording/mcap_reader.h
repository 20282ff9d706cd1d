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

  // The file ends before its end is told: what is behind the last whole record is left out.
  [[nodiscard]] bool cut() const { return cut_; }
  // How many bytes that is.
  [[nodiscard]] std::size_t bytes_left_out() const { return left_out_; }

  // By the name of the metadata record, then by key.
  using Texts = std::map<std::string, std::string, std::less<>>;
  [[nodiscard]] const std::map<std::string, Texts, std::less<>>& metadata() const {
    return metadata_;
  }
  // Checked; those of a name in the order of the file.
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
  std::size_t left_out_ = 0;
};

}  // namespace tactus::host
