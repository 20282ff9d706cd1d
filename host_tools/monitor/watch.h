// A run as lines of text: one a tick, `name=value` apart by blanks, for grep and awk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::host {

// The names that a field may have, those of the columns of a recording's CSV, of a run with that
// many joints.
std::vector<std::string> watch_fields(std::size_t joints);

// Writes ticks in the fields asked for.
class WatchLines {
 public:
  // Fields by name, or by a name's beginning before an underscore or a number ("force" for
  // force_x_N, force_y_N, force_z_N; "joint" for joint1 and on); none: the usual ones. Every
  // `every`-th tick, 1 or more.
  WatchLines(std::vector<std::string> fields, std::uint64_t every);

  // The line for a tick, without its newline; empty for one that is passed over. Throws InputError
  // at the first if a field is not known, with those that are.
  std::string line(const firmware::RecordedTick& tick);
  // Events are never passed over: "event tick=7 kind=parameter name=stiffness value=1000".
  static std::string line(const firmware::TelemetryEvent& event);

 private:
  void choose(std::size_t joints);

  std::vector<std::string> fields_;
  std::uint64_t every_ = 1;
  std::uint64_t seen_ = 0;
  std::size_t joints_ = 0;            // of the first tick; so many columns have all
  std::vector<std::string> names_;    // of all columns
  std::vector<std::size_t> columns_;  // those wanted, into names_
};

}  // namespace tactus::host
