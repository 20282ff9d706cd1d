#include "host_tools/recording/mcap_reader.h"

#include <algorithm>

#include "firmware/linux/telemetry/mcap_format.h"
#include "firmware/telemetry/crc32.h"
#include "host_tools/input_error.h"

namespace tactus::host {

namespace mcap = firmware::mcap;
using mcap::Opcode;
using mcap::Unpacker;

namespace {

// Throws InputError with the place in the file, bytes.
[[noreturn]] void complain_at(std::size_t offset, const std::string& what) {
  throw InputError("byte " + std::to_string(offset) + ": " + what);
}

}  // namespace

McapReader::McapReader(std::span<const std::byte> file) {
  const auto magic = std::as_bytes(std::span(mcap::kMagic));
  if (file.size() < magic.size() || !std::ranges::equal(file.first(magic.size()), magic)) {
    throw InputError("this is not an MCAP file");
  }
  auto rest = file.subspan(magic.size());
  while (!rest.empty()) {
    const auto before = rest;
    const std::size_t offset = file.size() - rest.size();
    const auto record = take_record(rest);
    if (!record) {
      return;
    }
    if (record->opcode == static_cast<std::uint8_t>(Opcode::data_end) ||
        record->opcode == static_cast<std::uint8_t>(Opcode::footer)) {
      cut_ = false;
      return;
    }
    take_top_level(*record, before.first(before.size() - rest.size()), offset);
  }
}

std::optional<McapReader::Record> McapReader::take_record(std::span<const std::byte>& rest) {
  Unpacker header(rest);
  const std::uint8_t opcode = header.u8();
  const std::uint64_t length = header.u64();
  const auto content = header.bytes(length);
  if (header.failed()) {
    return std::nullopt;
  }
  rest = header.rest();
  return Record{.opcode = opcode, .content = content};
}

void McapReader::take_top_level(const Record& record, std::span<const std::byte> whole,
                                std::size_t offset) {
  switch (static_cast<Opcode>(record.opcode)) {
    case Opcode::schema:
      return take_schema(record.content);
    case Opcode::channel:
      return take_channel(record.content);
    case Opcode::message:
      segments_.push_back({.records = whole, .offset = offset});
      return;
    case Opcode::chunk:
      return take_chunk(record.content, offset);
    case Opcode::metadata:
      return take_metadata(record.content);
    case Opcode::attachment:
      return take_attachment(record.content, offset);
    default:
      return;  // indexes, and what a later version may add
  }
}

void McapReader::take_chunk(std::span<const std::byte> content, std::size_t offset) {
  Unpacker chunk(content);
  // The start and end of the messages' times, ns, and the size of the records before compression.
  chunk.u64();
  chunk.u64();
  chunk.u64();
  const std::uint32_t crc = chunk.u32();
  const std::string_view compression = chunk.text();
  const auto records = chunk.bytes(chunk.u64());
  if (chunk.failed()) {
    complain_at(offset, "a chunk is shorter than it says");
  }
  if (!compression.empty()) {
    complain_at(offset, "a chunk is compressed by " + std::string(compression) +
                            ", which is not read here: unpack the file, "
                            "for example by `mcap compress --compression none`");
  }
  segments_.push_back({.records = records, .offset = offset, .crc = crc});
}

void McapReader::take_metadata(std::span<const std::byte> content) {
  Unpacker metadata(content);
  Texts& texts = metadata_[std::string(metadata.text())];
  Unpacker map(metadata.bytes(metadata.u32()));
  while (!map.rest().empty() && !map.failed()) {
    const std::string_view key = map.text();
    const std::string_view value = map.text();
    if (!map.failed()) {
      texts[std::string(key)] = value;
    }
  }
}

void McapReader::take_attachment(std::span<const std::byte> content, std::size_t offset) {
  Unpacker attachment(content);
  // When it was logged and when it was made, ns.
  attachment.u64();
  attachment.u64();
  const std::string name(attachment.text());
  // Its media type.
  attachment.text();
  const auto bytes = attachment.bytes(attachment.u64());
  // The checksum of an attachment covers everything before the checksum itself.
  const auto checked = content.first(content.size() - attachment.rest().size());
  const std::uint32_t crc = attachment.u32();
  if (attachment.failed()) {
    complain_at(offset, "an attachment is shorter than it says");
  }
  if (crc != 0 && crc != firmware::crc32(checked)) {
    complain_at(offset, "the attachment '" + name + "' is damaged: its checksum differs");
  }
  attachments_[name].push_back(bytes);
}

void McapReader::take_schema(std::span<const std::byte> content) {
  Unpacker schema(content);
  const std::uint16_t id = schema.u16();
  schemas_[id] = schema.text();
}

void McapReader::take_channel(std::span<const std::byte> content) {
  Unpacker channel(content);
  const std::uint16_t id = channel.u16();
  const std::uint16_t schema = channel.u16();
  channels_[id] = {.topic = channel.text(), .schema = schema};
}

McapMessage McapReader::message(std::span<const std::byte> content) const {
  Unpacker stored(content);
  const auto channel = channels_.find(stored.u16());
  McapMessage message;
  message.sequence = stored.u32();
  message.log_time_ns = stored.u64();
  stored.u64();  // time of publication
  message.data = stored.rest();
  if (channel != channels_.end()) {
    message.topic = channel->second.topic;
    const auto schema = schemas_.find(channel->second.schema);
    message.schema = schema != schemas_.end() ? schema->second : std::string_view{};
  }
  return message;
}

bool McapReader::open_segment() {
  if (next_segment_ == segments_.size()) {
    return false;
  }
  const Segment& segment = segments_[next_segment_];
  ++next_segment_;
  if (segment.crc != 0 && segment.crc != firmware::crc32(segment.records)) {
    complain_at(segment.offset, "a chunk is damaged: its checksum differs");
  }
  rest_ = segment.records;
  return true;
}

std::optional<McapMessage> McapReader::next() {
  while (!rest_.empty() || open_segment()) {
    if (rest_.empty()) {
      continue;
    }
    const auto record = take_record(rest_);
    if (!record) {
      const std::size_t offset = segments_[next_segment_ - 1].offset;
      rest_ = {};
      complain_at(offset, "a chunk ends in half a record");
    }
    switch (static_cast<Opcode>(record->opcode)) {
      case Opcode::schema:
        take_schema(record->content);
        break;
      case Opcode::channel:
        take_channel(record->content);
        break;
      case Opcode::message:
        return message(record->content);
      default:
        break;
    }
  }
  return std::nullopt;
}

void McapReader::rewind() {
  next_segment_ = 0;
  rest_ = {};
}

}  // namespace tactus::host
