// A run as tactusd, its flight recorder or `tactus sim` recorded it: the ticks one after the other,
// the events between them, the run's information and the images that it used. Replay, plots and
// inspection read runs through this class, each in its own process.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/recording/mcap_reader.h"

namespace tactus::host {

// An open recording, mapped into memory and read as it is asked for. One thread.
class Recording {
 public:
  // Opens a recording and reads all of its events. Throws InputError, with the file's name, if the
  // file cannot be read, is damaged, or is not a recording of this program.
  explicit Recording(const std::string& file);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording();

  // Returns the next tick in the order of the run; nothing at the end. Throws InputError where the
  // file is damaged or was written by a newer version.
  std::optional<firmware::RecordedTick> next();
  // Returns the next explanation in the order of the run, whatever next() has returned; nothing at
  // the end. Most runs have none. Throws InputError like next().
  std::optional<firmware::Explanation> next_explanation();
  // Makes next() and next_explanation() begin with the first ones again.
  void rewind();

  // Returns all events of the run, sorted by tick.
  [[nodiscard]] const std::vector<firmware::TelemetryEvent>& events() const { return events_; }

  // Returns the run's information under a key of firmware/telemetry/README.md; empty if there is
  // none.
  [[nodiscard]] std::string_view info(std::string_view key) const;
  // Returns all of the run's information, by key.
  [[nodiscard]] const McapReader::Texts& info() const { return info_; }

  // Returns the attachments of a name, in the order in which they were written. The names are in
  // firmware/linux/flight/attachments.h; a run that changed its scene has several "scene.tactus".
  [[nodiscard]] std::span<const std::span<const std::byte>> attachments(
      std::string_view name) const;
  // Returns the first attachment of a name; empty if there is none.
  [[nodiscard]] std::span<const std::byte> attachment(std::string_view name) const;

  // Returns true if the recording program was cut off: everything after the last whole chunk is
  // missing.
  [[nodiscard]] bool cut() const { return reader_->cut(); }

 private:
  // Collects the events of the whole file, sorted by tick.
  void read_events();

  std::string name_;
  // The mapped file, into which all views of the reader point.
  std::span<const std::byte> bytes_;
  std::unique_ptr<McapReader> reader_;
  // A reader for the explanations, which are behind their ticks; null before the first.
  std::unique_ptr<McapReader> explanations_;
  std::vector<firmware::TelemetryEvent> events_;
  McapReader::Texts info_;
};

}  // namespace tactus::host
