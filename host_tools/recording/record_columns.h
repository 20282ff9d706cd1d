// The columns of a recorded tick: every number of it, by the name that it has in a recording's CSV
// file. `tactus export` writes them; `tactus watch` chooses its fields by these names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::host {

// The state hash of a tick, which is written with sixteen hexadecimal digits.
struct HashValue {
  std::uint64_t hash = 0;
};

// The value of a column. Mode and request are words; other enumerations are numbers in the order of
// their definition.
using ColumnValue = std::variant<double, std::int64_t, std::uint64_t, HashValue, std::string_view>;

// Returns the names of all columns of a device with that many joints.
std::vector<std::string> column_names(std::size_t joints);

// Returns the columns that the fields stand for, as indices into column_names(). A field is a
// column's name or the beginning of several, before an underscore or a number: "force" stands for
// force_x_N, force_y_N and force_z_N, "joint" for joint1 and so on. Throws InputError, with the
// known names, for a field that stands for none.
std::vector<std::size_t> chosen_columns(std::span<const std::string> fields, std::size_t joints);

// Writes the values of all columns of a tick over `values`, in the order of column_names().
void read_columns(const firmware::RecordedTick& tick, std::size_t joints,
                  std::vector<ColumnValue>& values);

// Returns the word of an event's kind; "unknown" for one that this version does not know.
std::string_view kind_of(const firmware::TelemetryEvent& event);

}  // namespace tactus::host
