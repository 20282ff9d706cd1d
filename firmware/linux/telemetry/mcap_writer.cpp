#include "firmware/linux/telemetry/mcap_writer.h"

#include <algorithm>

#include "firmware/linux/telemetry/mcap_summary.h"

namespace tactus::firmware {

using mcap::Opcode;
using mcap::Packer;

namespace {

constexpr std::string_view kEncoding = "flatbuffer";
constexpr std::size_t kTextBytes = 4;  // the length in front of a text

// Returns the id of a channel and of its schema.
std::uint16_t id_of(auto channel) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(channel) + 1U);
}

}  // namespace

int McapWriter::open(const char* path, std::int64_t clock_offset_ns,
                     std::span<const MetadataEntry> run_info, IfThere if_there) {
  if (const int error = sink_.open(path, if_there); error != 0) {
    return error;
  }
  clock_offset_ns_ = clock_offset_ns;
  sequence_ = {};
  records_bytes_ = 0;
  message_count_ = 0;
  constexpr std::string_view kProfile;
  constexpr std::string_view kLibrary = "tactus";
  std::array<std::byte, 128> room;
  Packer header(room);
  header.bytes(std::as_bytes(std::span(mcap::kMagic)))
      .record(Opcode::header, kTextBytes + kTextBytes + kLibrary.size())
      .text(kProfile)
      .text(kLibrary);
  sink_.write(header.packed());
  write_metadata(run_info);
  write_channel(Channel::tick, record_schema(), kTickTopic);
  write_channel(Channel::event, event_schema(), kEventTopic);
  return sink_.error();
}

void McapWriter::write_channel(Channel channel, const MessageSchema& schema,
                               std::string_view topic) {
  std::array<std::byte, 256> room;
  Packer front(room);
  front
      .record(Opcode::schema, 2 + kTextBytes + schema.name.size() + kTextBytes + kEncoding.size() +
                                  4 + schema.bytes.size())
      .u16(id_of(channel))
      .text(schema.name)
      .text(kEncoding)
      .u32(static_cast<std::uint32_t>(schema.bytes.size()));
  sink_.write(front.packed());
  sink_.write(schema.bytes);
  Packer stored(room);
  stored
      .record(Opcode::channel,
              2 + 2 + kTextBytes + topic.size() + kTextBytes + kEncoding.size() + 4)
      .u16(id_of(channel))
      .u16(id_of(channel))
      .text(topic)
      .text(kEncoding)
      .u32(0);  // no metadata
  sink_.write(stored.packed());
}

void McapWriter::write_metadata(std::span<const MetadataEntry> entries) {
  std::size_t map_bytes = 0;
  for (const MetadataEntry& entry : entries) {
    map_bytes += kTextBytes + entry.key.size() + kTextBytes + entry.value.size();
  }
  std::array<std::byte, 64> room;
  Packer front(room);
  front.record(Opcode::metadata, kTextBytes + kMetadataName.size() + 4 + map_bytes)
      .text(kMetadataName)
      .u32(static_cast<std::uint32_t>(map_bytes));
  sink_.write(front.packed());
  for (const MetadataEntry& entry : entries) {
    for (const std::string_view text : {entry.key, entry.value}) {
      sink_.write(Packer(room).u32(static_cast<std::uint32_t>(text.size())).packed());
      sink_.write(std::as_bytes(std::span(text)));
    }
  }
}

void McapWriter::attach(const Attachment& attachment) {
  constexpr std::string_view kMediaType = "application/octet-stream";
  std::array<std::byte, 512> room;
  const std::string_view name = attachment.name.substr(0, 256);
  const std::uint64_t content = 8 + 8 + kTextBytes + name.size() + kTextBytes + kMediaType.size() +
                                8 + attachment.bytes.size() + 4;
  Packer front(room);
  front.record(Opcode::attachment, content)
      .u64(static_cast<std::uint64_t>(clock_offset_ns_))
      .u64(0)  // time of creation: not known
      .text(name)
      .text(kMediaType)
      .u64(attachment.bytes.size());
  Crc32 crc;
  crc.add(front.packed().subspan(mcap::kRecordHeaderBytes));
  crc.add(attachment.bytes);
  sink_.write(front.packed());
  sink_.write(attachment.bytes);
  sink_.write(Packer(room).u32(crc.value()).packed());
}

void McapWriter::add(const RecordedTick& tick, std::span<const std::byte> message) {
  add_message(Channel::tick, tick.loop.scheduled_ns, message);
}

void McapWriter::add(const TelemetryEvent& event, std::span<const std::byte> message) {
  add_message(Channel::event, event.time_ns, message);
}

// The first explanation brings its channel.
void McapWriter::add(const Explanation& explanation, std::span<const std::byte> message) {
  if (sequence_[static_cast<std::size_t>(Channel::explanation)] == 0) {
    flush();
    write_channel(Channel::explanation, explanation_schema(), kExplanationTopic);
  }
  add_message(Channel::explanation, explanation.time_ns, message);
}

void McapWriter::add_message(Channel channel, std::int64_t time_ns,
                             std::span<const std::byte> message) {
  const std::size_t content = mcap::kMessageHeaderBytes + message.size();
  if (records_bytes_ + mcap::kRecordHeaderBytes + content > kChunkBytes ||
      message_count_ == kMaxChunkMessages) {
    flush();
  }
  const auto log_time_ns = static_cast<std::uint64_t>(clock_offset_ns_ + time_ns);
  // A channel's messages are numbered from 0.
  std::uint32_t& sequence = sequence_[static_cast<std::size_t>(channel)];
  Packer record{std::span(chunk_).subspan(kFrontBytes, kChunkBytes).subspan(records_bytes_)};
  record.record(Opcode::message, content)
      .u16(id_of(channel))
      .u32(sequence)
      .u64(log_time_ns)
      .u64(log_time_ns)
      .bytes(message);
  index_[message_count_] = {.log_time_ns = log_time_ns,
                            .offset = static_cast<std::uint32_t>(records_bytes_),
                            .channel = channel};
  ++message_count_;
  ++sequence;
  records_bytes_ += record.size();
}

std::size_t McapWriter::pack_indexes(std::span<std::byte> room) const {
  Packer packer(room);
  const auto entries = std::span(index_).first(message_count_);
  for (const Channel channel : {Channel::tick, Channel::event, Channel::explanation}) {
    const auto count = std::ranges::count(entries, channel, &IndexEntry::channel);
    if (count == 0) {
      continue;
    }
    const std::uint32_t bytes = static_cast<std::uint32_t>(count) * 16U;
    packer.record(Opcode::message_index, 2U + 4U + bytes).u16(id_of(channel)).u32(bytes);
    for (const IndexEntry& entry : entries) {
      if (entry.channel == channel) {
        packer.u64(entry.log_time_ns).u64(entry.offset);
      }
    }
  }
  return packer.size();
}

void McapWriter::flush() {
  if (message_count_ == 0) {
    return;
  }
  const auto entries = std::span(index_).first(message_count_);
  const auto [first, last] = std::ranges::minmax(entries, {}, &IndexEntry::log_time_ns);
  const std::span<std::byte> chunk(chunk_);
  const auto records = chunk.subspan(kFrontBytes, records_bytes_);
  Packer(chunk.first(kFrontBytes))
      .record(Opcode::chunk, mcap::kChunkHeaderBytes + records_bytes_)
      .u64(first.log_time_ns)
      .u64(last.log_time_ns)
      .u64(records_bytes_)
      .u32(crc32(records))
      .text("")  // not compressed
      .u64(records_bytes_);
  const std::size_t index_bytes = pack_indexes(chunk.subspan(kFrontBytes + records_bytes_));
  // One write for chunk and indexes: after a crash, a chunk in the file has its indexes.
  sink_.write(chunk.first(kFrontBytes + records_bytes_ + index_bytes));
  records_bytes_ = 0;
  message_count_ = 0;
}

int McapWriter::close() {
  if (!sink_.is_open()) {
    return 0;
  }
  flush();
  write_mcap_summary(sink_);
  return sink_.close();
}

}  // namespace tactus::firmware
