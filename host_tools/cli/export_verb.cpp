#include "host_tools/cli/export_verb.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "host_tools/cli/progress_line.h"
#include "host_tools/export/export_run.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {
namespace {

constexpr const char* kExportExamples =
    "Writes every tick of a recording as CSV (.csv), as JSON with an object a line (.jsonl, "
    ".ndjson) or as arrays of\n"
    "numpy (.npz), by the extension of the output. The columns are those of a recording that "
    "tactusd writes as CSV; positions are "
    "in m in the world\n"
    "frame, forces in N, and the unit is the end of a column's name. A field is a column (--list) "
    "or "
    "the beginning of several:\n"
    "force, joint, energy. Numbers read back to the same bits; a number that is not finite is null "
    "in JSON.\n"
    "\n"
    "Without --output the table is beside the recording, run.csv for run.mcap, and no file that is "
    "there is replaced.\n"
    "\n"
    "Examples:\n"
    "  tactus export run.mcap                                      run.csv, all columns\n"
    "  tactus export run.mcap -o force.csv --fields time_s,tool,force\n"
    "  tactus export run.mcap -o run.jsonl --every 10              a hundred objects a second at 1 "
    "kHz\n"
    "  tactus export run.mcap -o tap.csv --from 2.5 --to 2.6       a tenth of a second\n"
    "  tactus export run.mcap -o run.csv --events events.csv       and what was set, asked for and "
    "injected\n"
    "  tactus export run.mcap -o /dev/stdout --fields depth | sort -g | tail -1\n"
    "  tactus export run.mcap -o run.npz                           an array for each column\n"
    "  python3 -c 'import numpy; print(numpy.load(\"run.npz\")[\"force_y_N\"].max())'";

// The verb's options as the user gave them.
struct ExportOptions {
  std::string recording;
  std::string output;
  std::string events;
  std::string format;
  ExportChoice choice;
  bool list = false;
};

// Returns the table's file: the one that was named, or a new one beside the recording. Throws
// InputError if that is there.
std::filesystem::path output_of(const ExportOptions& options) {
  if (!options.output.empty()) {
    return options.output;
  }
  std::filesystem::path beside = options.recording;
  beside.replace_extension(options.format.empty() ? "csv" : options.format);
  if (std::filesystem::exists(beside)) {
    throw InputError(
        fmt::format("{0} is there and is kept; name the output: -o {0}", beside.string()));
  }
  return beside;
}

// Returns the format that was named, or that of the file's extension; a pipe has CSV.
ExportFormat format_of(const ExportOptions& options, const std::filesystem::path& file) {
  if (const auto format = export_format(
          options.format.empty() ? file : std::filesystem::path("table." + options.format))) {
    return *format;
  }
  if (output_place(file, OutputKind::may_be_a_pipe).is_pipe) {
    return ExportFormat::csv;
  }
  throw InputError(fmt::format(
      "{}: the extension is none of .csv, .jsonl, .ndjson and .npz; say --format csv, jsonl or npz",
      file.string()));
}

// Returns the format of the file of events: by its extension, or that of the table. Throws
// InputError if the extension is that of arrays.
ExportFormat events_format_of(const ExportOptions& options, ExportFormat format) {
  const auto named = export_format(options.events);
  if (named == ExportFormat::npz) {
    throw InputError(
        fmt::format("{}: events are written as .csv, .jsonl or .ndjson", options.events));
  }
  return named.value_or(format == ExportFormat::npz ? ExportFormat::csv : format);
}

void list_fields(const ExportOptions& options) {
  Recording recording(options.recording);
  const auto first = recording.next();
  for (const std::string& name : column_names(first ? first->joint_count : drivers::kMaxJoints)) {
    fmt::print("{}\n", name);
  }
}

void run(const ExportOptions& options) {
  if (options.list) {
    list_fields(options);
    return;
  }
  const std::filesystem::path output = output_of(options);
  const ExportFormat format = format_of(options, output);
  const ExportFormat events_format = events_format_of(options, format);
  keep_inputs_safe({output, options.events}, {options.recording});
  Recording recording(options.recording);
  std::optional<ProgressLine> progress;
  if (::isatty(STDERR_FILENO) == 1) {
    progress.emplace();
  }
  const ExportSummary summary =
      export_ticks(recording, options.choice, format, output, [&](double time_s) {
        if (progress) {
          progress->step(fmt::format("{:.1f} s of the run", time_s));
        }
      });
  progress.reset();
  // Text for the user stays out of a table that goes to standard output.
  std::FILE* const words = is_standard_output(output) ? stderr : stdout;
  fmt::print(words, "{}: {} ticks of {} column{}, {:.3f} to {:.3f} s\n", output.string(),
             summary.ticks, summary.columns, summary.columns == 1 ? "" : "s", summary.first_s,
             summary.last_s);
  if (!options.events.empty()) {
    fmt::print(words, "{}: {} events\n", options.events,
               export_events(recording, events_format, options.events));
  }
  if (recording.cut()) {
    fmt::print(stderr,
               "tactus export: warning: the recording was cut off: its last ticks are "
               "missing\n");
  }
}

}  // namespace

void add_export_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("export", "Write a recording as CSV, JSON lines or NPZ");
  const auto options = std::make_shared<ExportOptions>();
  verb->add_option("recording", options->recording, "Recording (.mcap)")->required();
  verb->add_option("-o,--output", options->output,
                   "Table (.csv, .jsonl, .ndjson or .npz), or /dev/stdout (beside the recording)");
  verb->add_option("--format", options->format, "csv, jsonl or npz, whatever the extension")
      ->check(CLI::IsMember({"csv", "jsonl", "npz"}));
  verb->add_option("--fields", options->choice.fields, "Fields, apart by commas (all)")
      ->delimiter(',');
  verb->add_option("--every", options->choice.every, "Every so many ticks")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb->add_option("--from", options->choice.from_s, "The time of the run to begin at, s");
  verb->add_option("--to", options->choice.to_s, "The time of the run to end at, s");
  verb->add_option("--events", options->events, "Write the run's events to this file, too");
  verb->add_flag("--list", options->list, "Print the names of all fields");
  verb->footer(kExportExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
