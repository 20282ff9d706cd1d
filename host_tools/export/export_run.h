// Writes a recorded run as a table that other programs read: CSV, JSON with an object a line, or
// the arrays of numpy.
// `tactus export` uses it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/recording/recording.h"

namespace tactus::host {

// CSV has the columns and the text of a recording that tactusd writes as CSV. JSON lines have the
// columns as members; a number that is not finite is null there, and the state hash a text. NPZ has
// an array for each column (npz.h).
enum class ExportFormat : std::uint8_t { csv, json_lines, npz };

// Returns the format of a file's extension: .csv, .jsonl or .ndjson, .npz. Nothing for another.
std::optional<ExportFormat> export_format(const std::filesystem::path& file);

// The ticks that are written, and the columns of each.
struct ExportChoice {
  // Names of columns, or their beginnings (record_columns.h). Without any, all are written.
  std::vector<std::string> fields;
  // Every such tick is written, beginning with the first within the times.
  std::uint64_t every = 1;
  // The times of the run between which ticks are written, s.
  double from_s = -std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();
};

// The ticks that were written.
struct ExportSummary {
  std::uint64_t ticks = 0;
  double first_s = 0.0;
  double last_s = 0.0;
  std::size_t columns = 0;
};

// Writes the chosen ticks to a file, or to a pipe unless as NPZ. `see` is called with the time of
// every thousandth tick; the times begin anew if the recording is read several times. Throws
// InputError for a field that is not known, if there is no tick between the times, if the recording
// is damaged, or if the file cannot be written; a file that was there is then as it was.
ExportSummary export_ticks(Recording& recording, const ExportChoice& choice, ExportFormat format,
                           const std::filesystem::path& output,
                           const std::function<void(double time_s)>& see);

// Writes all events of the run as CSV or JSON lines: tick, kind, name, value. Returns their number.
// Throws InputError if the file cannot be written.
std::size_t export_events(const Recording& recording, ExportFormat format,
                          const std::filesystem::path& output);

}  // namespace tactus::host
