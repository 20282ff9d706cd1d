// A run as tactusd or `tactus sim` recorded it: its ticks one after the other, the events between
// them, and what the run was of.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/recording/mcap_reader.h"

namespace tactus::host {

class Recording {
 public:
  // Throws InputError, with the file's name, if the file cannot be read or is not of this program.
  explicit Recording(const std::string& file);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  // The next tick in the order of the run; empty at the end. Throws InputError where the file is
  // damaged.
  std::optional<firmware::RecordedTick> next();
  // Goes back to the first tick.
  void rewind() { reader_->rewind(); }

  // Returns all events of the run, sorted by tick.
  [[nodiscard]] const std::vector<firmware::TelemetryEvent>& events() const { return events_; }

  // Returns the run's information under a key of firmware/telemetry/README.md; empty if there is
  // none.
  [[nodiscard]] std::string_view info(std::string_view key) const;
  [[nodiscard]] const McapReader::Texts& info() const { return info_; }

  // The files of a name that are inside the recording, in the order in which they came:
  // "device.tactus", "scene.tactus".
  [[nodiscard]] std::span<const std::span<const std::byte>> attachments(
      std::string_view name) const;
  // The first of them. Empty if there is none.
  [[nodiscard]] std::span<const std::byte> attachment(std::string_view name) const;

  // The run was cut off: the file lacks what came after its last whole chunk.
  [[nodiscard]] bool cut() const { return reader_->cut(); }

 private:
  void read_events();

  std::string name_;
  std::span<const std::byte> bytes_;
  std::unique_ptr<McapReader> reader_;
  std::vector<firmware::TelemetryEvent> events_;
  McapReader::Texts info_;
};

}  // namespace tactus::host
