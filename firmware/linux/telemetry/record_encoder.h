// Encodes ticks, events, explanations, places and run information as FlatBuffers (record.fbs,
// event.fbs, explanation.fbs, object_places.fbs, run_info.fbs). It has its own memory and uses no
// heap. One thread.
#pragma once

#include <flatbuffers/flatbuffer_builder.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/object_places.h"
#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::firmware {

// The size of the buffer for a message and the builder's notes, bytes. No tick or event is longer;
// run information that would be longer is cut.
inline constexpr std::size_t kMaxMessageBytes = 8192;

// An entry of a run's information.
struct MetadataEntry {
  std::string_view key;
  std::string_view value;
};

// The encoder with its buffer.
class RecordEncoder {
 public:
  RecordEncoder();
  RecordEncoder(const RecordEncoder&) = delete;
  RecordEncoder& operator=(const RecordEncoder&) = delete;
  ~RecordEncoder() = default;

  // Return the encoded bytes, valid until the next call of any encode function. Equal input gives
  // equal bytes.
  std::span<const std::byte> encode(const RecordedTick& tick);
  std::span<const std::byte> encode(const TelemetryEvent& event);
  std::span<const std::byte> encode(const Explanation& explanation);
  std::span<const std::byte> encode(const ObjectPlaces& places);
  std::span<const std::byte> encode(std::span<const MetadataEntry> run_info);

 private:
  // Gives the builder the one buffer.
  class Memory final : public flatbuffers::Allocator {
   public:
    std::uint8_t* allocate(std::size_t size) override;
    void deallocate(std::uint8_t* memory, std::size_t size) override;

   private:
    alignas(std::max_align_t) std::array<std::uint8_t, kMaxMessageBytes> bytes_{};
  };

  // Returns the message that the builder has finished.
  [[nodiscard]] std::span<const std::byte> message() const;

  Memory memory_;
  flatbuffers::FlatBufferBuilder builder_;
};

// The binary schema (.bfbs) of a message.
struct MessageSchema {
  // The name of its root table.
  std::string_view name;
  std::span<const std::byte> bytes;
};
// Return the schemas of ticks, of events and of explanations, in static storage.
MessageSchema record_schema();
MessageSchema event_schema();
MessageSchema explanation_schema();

}  // namespace tactus::firmware
