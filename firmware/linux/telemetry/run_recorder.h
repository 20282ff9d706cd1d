// Records a run to a file: CSV if its name ends in .csv, MCAP otherwise. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/linux/telemetry/csv_writer.h"
#include "firmware/linux/telemetry/mcap_writer.h"

namespace tactus::firmware {

// The description of a run in its recordings. All that it points to must outlive them.
struct RunDescription {
  // The metadata; the keys are in firmware/telemetry/README.md.
  std::span<const MetadataEntry> info;
  // The number of joints of the device.
  std::size_t joints = 0;
  // The time since 1970, ns, at time 0 of the ticks' clock.
  std::int64_t clock_offset_ns = 0;
};

// Returns true if the name of a file says what kind of recording it is.
constexpr bool is_recording_name(std::string_view name) {
  return name.ends_with(".mcap") || name.ends_with(".csv");
}

// The recorder of one run: at most one file at a time.
class RunRecorder {
 public:
  // Sets the description. Call before the first recording.
  void describe(const RunDescription& run) { run_ = run; }

  // Adds an attachment to each MCAP file from now on, and to an open one at once. It replaces the
  // one with the same name. `name` and `bytes` must stay valid. Returns false if there is no room.
  bool attach(const Attachment& attachment);

  // Ends the present recording, if there is one, and starts another. Returns 0 or errno.
  int open(const char* path, IfThere if_there = IfThere::replace);
  // Add a tick, an event or an explanation to the open file, or do nothing without one. `message`
  // is its encoded form.
  void add(const RecordedTick& tick, std::span<const std::byte> message);
  void add(const TelemetryEvent& event, std::span<const std::byte> message);
  void add(const Explanation& explanation, std::span<const std::byte> message);
  // Writes the buffer to the file.
  void flush();
  // Closes the file. Returns 0 or the errno that ended it early; the file holds what came before.
  int close();

  // Returns true while a file is open.
  [[nodiscard]] bool is_open() const { return mcap_.is_open() || csv_.is_open(); }
  // Returns 0 or the errno that ended the open file.
  [[nodiscard]] int error() const { return mcap_.error() != 0 ? mcap_.error() : csv_.error(); }

 private:
  RunDescription run_;
  AttachmentList attachments_;
  McapWriter mcap_;
  CsvWriter csv_;
};

}  // namespace tactus::firmware
