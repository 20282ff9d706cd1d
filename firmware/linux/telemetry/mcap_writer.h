// Writes a run as an MCAP file: ticks, events and explanations as FlatBuffers in uncompressed
// chunks with their indexes and checksums, the run's metadata, and attachments.
//
// After a crash, a file lacks its summary and the last chunk; the chunks before are readable. The
// writer has its own memory, no heap and no exceptions. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/linux/telemetry/attachment_list.h"
#include "firmware/linux/telemetry/file_sink.h"
#include "firmware/linux/telemetry/mcap_format.h"
#include "firmware/linux/telemetry/record_encoder.h"

namespace tactus::firmware {

// The topics of the channels, and the name of the metadata record. A file without explanations has
// no channel for them.
inline constexpr std::string_view kTickTopic = "/tactus/tick";
inline constexpr std::string_view kEventTopic = "/tactus/event";
inline constexpr std::string_view kExplanationTopic = "/tactus/explanation";
inline constexpr std::string_view kMetadataName = "tactus";

// The writer of one file.
class McapWriter {
 public:
  // Creates the file. `clock_offset_ns` is added to LoopTimes::scheduled_ns to give the log time of
  // a message, ns since 1970. Returns 0 or errno.
  int open(const char* path, std::int64_t clock_offset_ns, std::span<const MetadataEntry> run_info,
           IfThere if_there = IfThere::replace);
  // Writes an attachment with its bytes at once.
  void attach(const Attachment& attachment);

  // Add a tick, an event or an explanation to the open chunk.
  void add(const RecordedTick& tick) { add(tick, encoder_.encode(tick)); }
  void add(const TelemetryEvent& event) { add(event, encoder_.encode(event)); }
  void add(const Explanation& explanation) { add(explanation, encoder_.encode(explanation)); }
  // Add one that has been encoded already.
  void add(const RecordedTick& tick, std::span<const std::byte> message);
  void add(const TelemetryEvent& event, std::span<const std::byte> message);
  void add(const Explanation& explanation, std::span<const std::byte> message);
  // Writes the open chunk to the file.
  void flush();

  // Writes the open chunk and the summary and closes the file. Returns 0 or the errno of the first
  // failure; the file then holds what came before it.
  int close();

  // Returns true between open() and close().
  [[nodiscard]] bool is_open() const { return sink_.is_open(); }
  // Returns 0 or the errno that ended the recording.
  [[nodiscard]] int error() const { return sink_.error(); }

 private:
  // The largest size of a chunk's records, and the largest number of its messages.
  static constexpr std::size_t kChunkBytes = std::size_t{256} << 10U;
  static constexpr std::size_t kMaxChunkMessages = 1024;
  // The size of a chunk's header.
  static constexpr std::size_t kFrontBytes = mcap::kRecordHeaderBytes + mcap::kChunkHeaderBytes;
  static constexpr std::size_t kChannelCount = 3;
  // The largest size of the indexes after a chunk: 16 bytes a message.
  static constexpr std::size_t kIndexBytes =
      kChannelCount * (mcap::kRecordHeaderBytes + 2 + 4) + 16 * kMaxChunkMessages;

  // The channels; their ids in the file are 1, 2 and 3.
  enum class Channel : std::uint8_t { tick, event, explanation };

  // A message of the open chunk.
  struct IndexEntry {
    std::uint64_t log_time_ns = 0;
    // The number of bytes from the first record of the chunk.
    std::uint32_t offset = 0;
    Channel channel = Channel::tick;
  };

  // Writes a schema and the channel that uses it; both have the same id.
  void write_channel(Channel channel, const MessageSchema& schema, std::string_view topic);
  // Writes the run's metadata record.
  void write_metadata(std::span<const MetadataEntry> entries);
  // Appends a message to the open chunk, after writing the chunk if it is full.
  void add_message(Channel channel, std::int64_t time_ns, std::span<const std::byte> message);
  // Packs the message indexes of the open chunk and returns their size, bytes.
  std::size_t pack_indexes(std::span<std::byte> room) const;

  FileSink sink_;
  RecordEncoder encoder_;
  std::int64_t clock_offset_ns_ = 0;
  // The number of messages of each channel.
  std::array<std::uint32_t, kChannelCount> sequence_{};

  // The open chunk: its header, its records and the indexes after it.
  std::array<std::byte, kFrontBytes + kChunkBytes + kIndexBytes> chunk_{};
  std::size_t records_bytes_ = 0;
  std::array<IndexEntry, kMaxChunkMessages> index_{};
  std::size_t message_count_ = 0;
};

}  // namespace tactus::firmware
