// A run as lines of text, one a tick, `name=value` separated by blanks, for grep and awk. `tactus
// watch` prints them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/monitor/tick_words.h"

namespace tactus::host {

// Turns ticks into lines of the fields that the user asked for.
class WatchLines {
 public:
  // `fields` are those of chosen_columns() (recording/record_columns.h). Without any it writes the
  // usual ones. It writes every `every`-th tick.
  WatchLines(std::vector<std::string> fields, std::uint64_t every);

  // Returns the line of a tick without its newline; empty for a tick that is passed over. The first
  // call throws InputError, with the known fields, if a field is not known.
  std::string line(const firmware::RecordedTick& tick);
  // Returns the line of an event; events are never passed over. An example: "event tick=7
  // kind=parameter name=stiffness value=1000".
  static std::string line(const firmware::TelemetryEvent& event);

 private:
  std::vector<std::string> fields_;
  std::uint64_t every_ = 1;
  std::uint64_t seen_ = 0;
  // The joints of the first tick, which decide the columns of all.
  std::size_t joints_ = 0;
  // The names of all columns.
  std::vector<std::string> names_;
  // The columns that are printed, as indices into `names_`.
  std::vector<std::size_t> columns_;
  // The texts of all columns of the newest tick.
  std::vector<TickWord> words_;
};

}  // namespace tactus::host
