// One recording of a run: an MCAP file, or CSV where the file's name ends in .csv. Not real time;
// one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/telemetry/outputs/csv_writer.h"
#include "firmware/telemetry/outputs/mcap_writer.h"

namespace tactus::firmware {

// What is noted of a run; whatever it points to outlives the recordings.
struct RunDescription {
  std::span<const MetadataEntry> info;  // by the keys of firmware/telemetry/README.md
  std::size_t joints = 0;
  std::int64_t clock_offset_ns = 0;  // from the ticks' clock to ns since 1970
};

class RunRecorder {
 public:
  // Before the first recording.
  void describe(const RunDescription& run) { run_ = run; }

  // Goes into each MCAP file from now on, in place of one of the same name; into an open one at
  // once. False if there is no room. `name` and `bytes` stay where they are.
  bool attach(const Attachment& attachment);

  // Ends the recording before, if there is one. 0, or errno.
  int open(const char* path, IfThere if_there = IfThere::replace);
  void add(const RecordedTick& tick, std::span<const std::byte> message);
  void add(const TelemetryEvent& event, std::span<const std::byte> message);
  // Puts what there is into the file.
  void flush();
  // 0, or the errno that ended it early: what came before is in the file.
  int close();

  [[nodiscard]] bool is_open() const { return mcap_.is_open() || csv_.is_open(); }
  [[nodiscard]] int error() const { return mcap_.error() != 0 ? mcap_.error() : csv_.error(); }

 private:
  RunDescription run_;
  AttachmentList attachments_;
  McapWriter mcap_;
  CsvWriter csv_;
};

}  // namespace tactus::firmware
