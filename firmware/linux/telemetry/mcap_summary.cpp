#include "firmware/linux/telemetry/mcap_summary.h"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "firmware/linux/telemetry/mcap_format.h"
#include "firmware/linux/telemetry/mcap_walk.h"

namespace tactus::firmware {

using mcap::Found;
using mcap::Opcode;
using mcap::Packer;
using mcap::Unpacker;
using mcap::Walk;

namespace {

// The largest number of channels, which have the ids 1 to 8.
constexpr std::size_t kMaxChannels = 8;

// The numbers of the statistics record. Times are log times, ns since 1970.
struct Statistics {
  std::uint32_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t first_ns = 0;
  std::uint64_t last_ns = 0;
  std::array<std::uint64_t, kMaxChannels> messages{};
};

// The message indexes that follow a chunk.
struct ChunkIndexes {
  std::uint64_t bytes = 0;
  // The place of each channel's index in the file; 0: none.
  std::array<std::uint64_t, kMaxChannels> offsets{};
};

// Writes the summary. Each group reads the whole data section again, so that no list is kept.
class Summary {
 public:
  explicit Summary(FileSink& sink) : sink_(&sink), data_end_(sink.size()) {}

  void write() {
    std::array<std::byte, 64> room;
    sink_->write(Packer(room).record(Opcode::data_end, 4).u32(sink_->crc()).packed());
    sink_->restart_crc();
    const std::uint64_t start = sink_->size();
    group(Opcode::schema, [this] { copy_all(Opcode::schema); });
    group(Opcode::channel, [this] { copy_all(Opcode::channel); });
    group(Opcode::chunk_index, [this] { index_chunks(); });
    group(Opcode::attachment_index, [this] { index_attachments(); });
    group(Opcode::metadata_index, [this] { index_metadata(); });
    group(Opcode::statistics, [this] { write_statistics(); });
    const std::uint64_t offsets = sink_->size();
    for (const Group& one : std::span(groups_).first(group_count_)) {
      sink_->write(Packer(room)
                       .record(Opcode::summary_offset, 1 + 8 + 8)
                       .u8(static_cast<std::uint8_t>(one.opcode))
                       .u64(one.start)
                       .u64(one.length)
                       .packed());
    }
    sink_->write(Packer(room).record(Opcode::footer, 8 + 8 + 4).u64(start).u64(offsets).packed());
    sink_->write(
        Packer(room).u32(sink_->crc()).bytes(std::as_bytes(std::span(mcap::kMagic))).packed());
  }

 private:
  // A group of records of one kind, for the summary's offsets.
  struct Group {
    Opcode opcode = Opcode::none;
    std::uint64_t start = 0;
    std::uint64_t length = 0;
  };

  // Writes records and notes their place.
  void group(Opcode opcode, auto&& write_records) {
    const std::uint64_t start = sink_->size();
    write_records();
    if (sink_->size() > start) {
      groups_[group_count_] = {.opcode = opcode, .start = start, .length = sink_->size() - start};
      ++group_count_;
    }
  }

  // Copies all records of a kind.
  void copy_all(Opcode opcode) {
    Walk walk(*sink_, data_end_);
    Found found;
    while (walk.next(found)) {
      if (found.opcode == opcode) {
        copy(found);
        (opcode == Opcode::schema ? statistics_.schemas : statistics_.channels) += 1;
      }
    }
  }

  // Copies one record by parts.
  void copy(const Found& found) {
    std::array<std::byte, 4096> part;
    for (std::uint64_t done = 0; done < found.length;) {
      const auto wanted =
          static_cast<std::size_t>(std::min<std::uint64_t>(part.size(), found.length - done));
      const ssize_t count =
          pread(sink_->descriptor(), part.data(), wanted, static_cast<off_t>(found.offset + done));
      if (count <= 0) {
        return;
      }
      sink_->write(std::span(part).first(static_cast<std::size_t>(count)));
      done += static_cast<std::uint64_t>(count);
    }
  }

  // Writes an index for each chunk. Its message indexes come right after it in the file.
  void index_chunks() {
    Walk walk(*sink_, data_end_);
    Found found;
    Found chunk;
    ChunkIndexes indexes;
    bool open = false;
    while (walk.next(found)) {
      if (found.opcode == Opcode::message_index && open) {
        note_message_index(found, indexes);
        continue;
      }
      if (open) {
        write_chunk_index(chunk, indexes);
      }
      open = found.opcode == Opcode::chunk;
      if (open) {
        chunk = found;
        indexes = {};
      }
    }
    if (open) {
      write_chunk_index(chunk, indexes);
    }
  }

  // Takes the place of a message index and the number of its entries, which have 16 bytes each.
  void note_message_index(const Found& found, ChunkIndexes& indexes) {
    Unpacker content = found.content();
    const std::size_t channel = content.u16() - std::size_t{1};
    if (channel < kMaxChannels) {
      indexes.offsets[channel] = found.offset;
      statistics_.messages[channel] += content.u32() / 16U;
    }
    indexes.bytes += found.length;
  }

  // Writes the index of a chunk and counts its times.
  void write_chunk_index(const Found& chunk, const ChunkIndexes& indexes) {
    Unpacker content = chunk.content();
    const std::uint64_t first_ns = content.u64();
    const std::uint64_t last_ns = content.u64();
    const std::uint64_t bytes = content.u64();
    statistics_.first_ns =
        statistics_.chunks == 0 ? first_ns : std::min(statistics_.first_ns, first_ns);
    statistics_.last_ns = std::max(statistics_.last_ns, last_ns);
    ++statistics_.chunks;
    const auto channels = static_cast<std::uint32_t>(
        std::ranges::count_if(indexes.offsets, [](std::uint64_t offset) { return offset != 0; }));
    const std::uint32_t map_bytes = channels * (2U + 8U);
    std::array<std::byte, 256> room;
    Packer record(room);
    record.record(Opcode::chunk_index, 8 + 8 + 8 + 8 + 4 + map_bytes + 8 + 4 + 8 + 8)
        .u64(first_ns)
        .u64(last_ns)
        .u64(chunk.offset)
        .u64(chunk.length)
        .u32(map_bytes);
    for (std::size_t i = 0; i < kMaxChannels; ++i) {
      if (indexes.offsets[i] != 0) {
        record.u16(static_cast<std::uint16_t>(i + 1)).u64(indexes.offsets[i]);
      }
    }
    record.u64(indexes.bytes).text("").u64(bytes).u64(bytes);
    sink_->write(record.packed());
  }

  // Writes an index for each attachment.
  void index_attachments() {
    Walk walk(*sink_, data_end_);
    Found found;
    while (walk.next(found)) {
      if (found.opcode != Opcode::attachment) {
        continue;
      }
      ++statistics_.attachments;
      Unpacker content = found.content();
      const std::uint64_t logged_ns = content.u64();
      const std::uint64_t created_ns = content.u64();
      const std::string_view name = content.text();
      const std::string_view media_type = content.text();
      const std::uint64_t bytes = content.u64();
      std::array<std::byte, 512> room;
      sink_->write(Packer(room)
                       .record(Opcode::attachment_index,
                               8 + 8 + 8 + 8 + 8 + 4 + name.size() + 4 + media_type.size())
                       .u64(found.offset)
                       .u64(found.length)
                       .u64(logged_ns)
                       .u64(created_ns)
                       .u64(bytes)
                       .text(name)
                       .text(media_type)
                       .packed());
    }
  }

  // Writes an index for each metadata record.
  void index_metadata() {
    Walk walk(*sink_, data_end_);
    Found found;
    while (walk.next(found)) {
      if (found.opcode != Opcode::metadata) {
        continue;
      }
      ++statistics_.metadata;
      Unpacker content = found.content();
      const std::string_view name = content.text();
      std::array<std::byte, 512> room;
      sink_->write(Packer(room)
                       .record(Opcode::metadata_index, 8 + 8 + 4 + name.size())
                       .u64(found.offset)
                       .u64(found.length)
                       .text(name)
                       .packed());
    }
  }

  void write_statistics() {
    std::uint64_t messages = 0;
    std::uint32_t map_bytes = 0;
    for (const std::uint64_t count : statistics_.messages) {
      messages += count;
      map_bytes += count != 0 ? 2U + 8U : 0U;
    }
    std::array<std::byte, 256> room;
    Packer record(room);
    record.record(Opcode::statistics, 8 + 2 + 4 + 4 + 4 + 4 + 8 + 8 + 4 + map_bytes)
        .u64(messages)
        .u16(static_cast<std::uint16_t>(statistics_.schemas))
        .u32(statistics_.channels)
        .u32(statistics_.attachments)
        .u32(statistics_.metadata)
        .u32(statistics_.chunks)
        .u64(statistics_.first_ns)
        .u64(statistics_.last_ns)
        .u32(map_bytes);
    for (std::size_t i = 0; i < kMaxChannels; ++i) {
      if (statistics_.messages[i] != 0) {
        record.u16(static_cast<std::uint16_t>(i + 1)).u64(statistics_.messages[i]);
      }
    }
    sink_->write(record.packed());
  }

  FileSink* sink_;
  std::uint64_t data_end_;
  Statistics statistics_;
  std::array<Group, 6> groups_{};
  std::size_t group_count_ = 0;
};

}  // namespace

void write_mcap_summary(FileSink& sink) {
  Summary(sink).write();
}

}  // namespace tactus::firmware
