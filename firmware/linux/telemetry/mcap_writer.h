// Writes a run as an MCAP file: ticks and events as FlatBuffers in uncompressed chunks with their
// indexes and checksums, the run's metadata, and attachments.
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

inline constexpr std::string_view kTickTopic = "/tactus/tick";
inline constexpr std::string_view kEventTopic = "/tactus/event";
inline constexpr std::string_view kMetadataName = "tactus";

class McapWriter {
 public:
  // Creates the file. `clock_offset_ns` is added to LoopTimes::scheduled_ns to give the log time of
  // a message, ns since 1970. Returns 0 or errno.
  int open(const char* path, std::int64_t clock_offset_ns, std::span<const MetadataEntry> run_info,
           IfThere if_there = IfThere::replace);
  void attach(const Attachment& attachment);

  void add(const RecordedTick& tick) { add(tick, encoder_.encode(tick)); }
  void add(const TelemetryEvent& event) { add(event, encoder_.encode(event)); }
  // Add a tick or an event that has been encoded already.
  void add(const RecordedTick& tick, std::span<const std::byte> message);
  void add(const TelemetryEvent& event, std::span<const std::byte> message);
  // Writes the open chunk to the file.
  void flush();

  // Writes the open chunk and the summary and closes the file. Returns 0 or the errno of the first
  // failure; the file then holds what came before it.
  int close();

  [[nodiscard]] bool is_open() const { return sink_.is_open(); }
  // Returns 0 or the errno that ended the recording.
  [[nodiscard]] int error() const { return sink_.error(); }

 private:
  static constexpr std::size_t kChunkBytes = std::size_t{256} << 10U;
  static constexpr std::size_t kMaxChunkMessages = 1024;
  static constexpr std::size_t kFrontBytes = mcap::kRecordHeaderBytes + mcap::kChunkHeaderBytes;
  static constexpr std::size_t kChannelCount = 2;
  static constexpr std::size_t kIndexBytes =
      kChannelCount * (mcap::kRecordHeaderBytes + 2 + 4) + 16 * kMaxChunkMessages;

  enum class Channel : std::uint8_t { tick, event };  // id - 1

  struct IndexEntry {
    std::uint64_t log_time_ns = 0;
    std::uint32_t offset = 0;  // bytes from the first record of the chunk
    Channel channel = Channel::tick;
  };

  void write_channel(Channel channel, const MessageSchema& schema, std::string_view topic);
  void write_metadata(std::span<const MetadataEntry> entries);
  void add_message(Channel channel, std::int64_t time_ns, std::span<const std::byte> message);
  std::size_t pack_indexes(std::span<std::byte> room) const;

  FileSink sink_;
  RecordEncoder encoder_;
  std::int64_t clock_offset_ns_ = 0;
  std::array<std::uint32_t, kChannelCount> sequence_{};

  // The open chunk: its header, its records and the indexes after it.
  std::array<std::byte, kFrontBytes + kChunkBytes + kIndexBytes> chunk_{};
  std::size_t records_bytes_ = 0;
  std::array<IndexEntry, kMaxChunkMessages> index_{};
  std::size_t message_count_ = 0;
};

}  // namespace tactus::firmware
