// Ticks and events as FlatBuffers, by record.fbs, event.fbs and run_info.fbs. In memory of its own:
// no heap. One thread.
#pragma once

#include <flatbuffers/flatbuffer_builder.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::firmware {

// A message is never longer, with room for what a builder notes beside it; run information that
// would be is cut.
inline constexpr std::size_t kMaxMessageBytes = 8192;

struct MetadataEntry {
  std::string_view key;
  std::string_view value;
};

class RecordEncoder {
 public:
  RecordEncoder();
  RecordEncoder(const RecordEncoder&) = delete;
  RecordEncoder& operator=(const RecordEncoder&) = delete;
  ~RecordEncoder() = default;

  // Each valid until the next call of any. The same numbers give the same bytes.
  std::span<const std::byte> encode(const RecordedTick& tick);
  std::span<const std::byte> encode(const TelemetryEvent& event);
  std::span<const std::byte> encode(std::span<const MetadataEntry> run_info);

 private:
  // Hands out the one block that there is.
  class Memory final : public flatbuffers::Allocator {
   public:
    std::uint8_t* allocate(std::size_t size) override;
    void deallocate(std::uint8_t* memory, std::size_t size) override;

   private:
    alignas(std::max_align_t) std::array<std::uint8_t, kMaxMessageBytes> bytes_{};
  };

  [[nodiscard]] std::span<const std::byte> message() const;

  Memory memory_;
  flatbuffers::FlatBufferBuilder builder_;
};

// The binary schemas (.bfbs) of the messages and the names of their root tables.
struct MessageSchema {
  std::string_view name;
  std::span<const std::byte> bytes;
};
MessageSchema record_schema();
MessageSchema event_schema();

}  // namespace tactus::firmware
