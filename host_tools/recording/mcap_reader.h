// Reads MCAP files (https://mcap.dev/spec), whole or cut off by a crash, as long as their chunks
// are not compressed. Recording uses it; it knows nothing of what the messages contain.
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

// One message of the file. The views point into the file's bytes.
struct McapMessage {
  // The topic of the message's channel; empty if the file does not define the channel.
  std::string_view topic;
  // The name of the schema of the message's channel, for example "tactus.telemetry.Record".
  std::string_view schema;
  // The message's number within its channel, as its writer counted.
  std::uint32_t sequence = 0;
  // When the message was recorded, ns since 1970 in the recordings of this program.
  std::uint64_t log_time_ns = 0;
  // The message itself, in the encoding of its channel.
  std::span<const std::byte> data;
};

// Reads an MCAP file that is in memory. All views that it returns point into `file`, which must
// outlive them. One thread.
class McapReader {
 public:
  // Finds all chunks, metadata and attachments; chunks are opened by next(). Throws InputError if
  // the bytes are no MCAP file, a chunk is compressed, or the checksum of an attachment is wrong.
  explicit McapReader(std::span<const std::byte> file);

  // Returns the next message in the order of the file; nothing at the end. Throws InputError with
  // the place in bytes at a chunk whose checksum is wrong or that ends within a record.
  std::optional<McapMessage> next();
  // Makes next() begin with the first message again.
  void rewind();

  // Returns true if the file ends without its end record: the program that wrote it did not come to
  // its end. Half of a record at the end is ignored.
  [[nodiscard]] bool cut() const { return cut_; }

  // The metadata records by their name, each a map from key to text.
  using Texts = std::map<std::string, std::string, std::less<>>;
  [[nodiscard]] const std::map<std::string, Texts, std::less<>>& metadata() const {
    return metadata_;
  }
  // The attachments by name, with those of one name in the order of the file. Their checksums were
  // compared when the reader was made.
  using Attachments = std::map<std::string, std::vector<std::span<const std::byte>>, std::less<>>;
  [[nodiscard]] const Attachments& attachments() const { return attachments_; }

 private:
  // A channel: what its messages are about, and the number of their schema.
  struct Channel {
    std::string_view topic;
    std::uint16_t schema = 0;
  };
  // A stretch of records that follow each other: the content of a chunk, or one message outside of
  // chunks.
  struct Segment {
    std::span<const std::byte> records;
    // The offset of the chunk or message in the file, bytes, for messages to the user.
    std::size_t offset = 0;
    // The checksum of `records`; 0 if the writer computed none.
    std::uint32_t crc = 0;
  };
  // One record of the format: what it is, and the bytes after its header.
  struct Record {
    std::uint8_t opcode = 0;
    std::span<const std::byte> content;
  };

  // Takes the first record off `rest`; returns nothing and leaves `rest` if it is not whole.
  static std::optional<Record> take_record(std::span<const std::byte>& rest);
  // Takes over a record outside of chunks; `whole` is the record with its header. Unknown kinds are
  // left out.
  void take_top_level(const Record& record, std::span<const std::byte> whole, std::size_t offset);
  // Notes the chunk's records for next(). Throws InputError if the chunk is compressed or too
  // short.
  void take_chunk(std::span<const std::byte> content, std::size_t offset);
  // Adds the texts of a metadata record to those of its name.
  void take_metadata(std::span<const std::byte> content);
  // Adds an attachment. Throws InputError if it is too short or its checksum differs.
  void take_attachment(std::span<const std::byte> content, std::size_t offset);
  // Notes a schema's name by its number.
  void take_schema(std::span<const std::byte> content);
  // Notes a channel's topic and schema by its number.
  void take_channel(std::span<const std::byte> content);
  // Returns the message of a record, with the topic and schema of its channel.
  [[nodiscard]] McapMessage message(std::span<const std::byte> content) const;
  // Goes on to the next segment after comparing its checksum; returns false after the last.
  bool open_segment();

  std::vector<Segment> segments_;
  std::size_t next_segment_ = 0;
  // The records of the open segment that next() has not looked at.
  std::span<const std::byte> rest_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::uint16_t, std::string_view> schemas_;
  std::map<std::string, Texts, std::less<>> metadata_;
  Attachments attachments_;
  // True until the end record is found.
  bool cut_ = true;
};

}  // namespace tactus::host
