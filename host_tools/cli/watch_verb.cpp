#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "host_tools/cli/monitor_verb.h"
#include "host_tools/cli/reach_controller.h"
#include "host_tools/cli/run_folder_option.h"
#include "host_tools/input_error.h"
#include "host_tools/monitor/explain_line.h"
#include "host_tools/monitor/watch.h"
#include "host_tools/recording/live_reader.h"
#include "host_tools/recording/record_columns.h"

namespace tactus::host {
namespace {

constexpr const char* kWatchExamples =
    "A line a tick, name=value apart by blanks, until the controller ends or the reader has had "
    "enough; events are lines\n"
    "that begin with 'event'. A field is a column of a recording (--list), or the beginning of "
    "several: force, joint, energy.\n"
    "\n"
    "Examples:\n"
    "  tactus watch                                     the usual fields of every tick\n"
    "  tactus watch --fields tick,force --every 100     ten lines a second at 1 kHz\n"
    "  tactus watch | grep -m 1 'mode=fault'            waits for a fault\n"
    "  tactus watch --explain --every 100               the feature, planes, friction circle and "
    "step times\n"
    "  tactus watch --explain | grep -m 1 'state=edge'  the first tick at an edge\n"
    "  tactus watch --fields mode,joint --seconds 1 | wc -l\n"
    "  tactus watch --serial /dev/ttyACM0               a bare board at the other end of a line";

// The verb's options as the user gave them.
struct WatchOptions {
  RunFolderOption run;
  std::vector<std::string> fields;
  std::uint64_t every = 1;
  double seconds = 0.0;
  bool list = false;
  bool explain = false;
};

// Prints a line; empty ones are left out. Returns false if the reader has closed the pipe. Throws
// InputError if the output cannot be written.
bool print_line(const std::string& line) {
  if (!line.empty() && (std::fputs(line.c_str(), stdout) < 0 || std::fputc('\n', stdout) < 0)) {
    if (errno == EPIPE) {
      return false;
    }
    throw InputError("standard output cannot be written; is the disk full?");
  }
  return true;
}

// Turns messages into the lines that the user asked for.
class Lines {
 public:
  explicit Lines(const WatchOptions& options)
      : ticks_(options.fields, options.every), explains_(options.explain), every_(options.every) {}

  // Returns the line of a message; empty if it has none. Throws InputError if the controller sends
  // no explanations.
  std::string line_of(const LiveMessage& message);

 private:
  // Returns the line of an explanation; empty for one that is passed over.
  std::string line_of(const firmware::Explanation& explanation) {
    has_explained_ = true;
    return explanations_++ % every_ == 0 ? explain_line(explanation) : std::string{};
  }

  WatchLines ticks_;
  bool explains_;
  std::uint64_t every_;
  std::uint64_t explanations_ = 0;
  bool has_explained_ = false;
  // The time of the first tick's record, s.
  std::optional<double> begin_s_;
};

std::string Lines::line_of(const LiveMessage& message) {
  // Every controller of this version explains its ticks sooner than this.
  constexpr double kPatience_s = 5.0;
  if (const auto* tick = std::get_if<firmware::RecordedTick>(&message)) {
    if (!explains_) {
      return ticks_.line(*tick);
    }
    const double time_s = tick->record.time_s;
    begin_s_ = begin_s_.value_or(time_s);
    if (!has_explained_ && time_s - *begin_s_ > kPatience_s) {
      throw InputError("the controller sends no explanations: it is of an older version");
    }
    return {};
  }
  if (const auto* explanation = std::get_if<firmware::Explanation>(&message)) {
    return line_of(*explanation);
  }
  if (const auto* event = std::get_if<firmware::TelemetryEvent>(&message)) {
    return WatchLines::line(*event);
  }
  return {};
}

// Written by a signal, read by the loop.
volatile std::sig_atomic_t watch_is_to_end = 0;

// A board takes a program that ends by a signal for a lost line, so Ctrl-C has to end it in order.
void end_on_signals() {
  const auto on_end = [](int /*signal*/) { watch_is_to_end = 1; };
  std::signal(SIGINT, on_end);
  std::signal(SIGTERM, on_end);
}

void print_run(const WatchOptions& options, const std::filesystem::path& folder) {
  using std::chrono::steady_clock;
  // A closed pipe is then an error of the write that finds it, not a signal that ends the program.
  std::signal(SIGPIPE, SIG_IGN);
  LiveReader reader((folder / kLiveSocketFile).string());
  reader.ask_for_explanations(options.explain);
  Lines lines(options);
  const auto begin = steady_clock::now();
  const auto over = [&] {
    return watch_is_to_end != 0 ||
           (options.seconds > 0.0 &&
            steady_clock::now() - begin >= std::chrono::duration<double>(options.seconds));
  };
  while (!reader.ended() && !over()) {
    const auto message = reader.next(std::chrono::milliseconds(0));
    if (message && !print_line(lines.line_of(*message))) {
      return;
    }
    if (!message) {
      // There is nothing more to read now, so the printed lines are shown.
      if (std::fflush(stdout) != 0 && errno == EPIPE) {
        return;
      }
      const auto next = reader.next(std::chrono::milliseconds(100));
      if (next && !print_line(lines.line_of(*next))) {
        return;
      }
    }
  }
  std::fflush(stdout);
}

void run(const WatchOptions& options) {
  if (!options.list) {
    if (options.explain && !options.run.serial.empty()) {
      throw InputError("a board sends no explanations: record it, and use tactus replay --explain");
    }
    with_controller(options.run, {.ticks = true},
                    [&](const std::filesystem::path& folder, const LineSession* line) {
                      if (line != nullptr) {
                        end_on_signals();
                      }
                      print_run(options, folder);
                    });
    return;
  }
  for (const std::string& field : column_names(drivers::kMaxJoints)) {
    fmt::print("{}\n", field);
  }
}

}  // namespace

void add_watch_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("watch", "Print a running controller's ticks as lines");
  const auto options = std::make_shared<WatchOptions>();
  add_run_folder_option(*verb, options->run);
  verb->add_option("--fields", options->fields, "Fields, apart by commas")->delimiter(',');
  verb->add_option("--every", options->every, "Every so many ticks")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb->add_option("--seconds", options->seconds, "End after so long; default: with the controller")
      ->check(CLI::NonNegativeNumber);
  verb->add_flag("--explain", options->explain,
                 "Print how each tick came to its result instead of its fields")
      ->excludes(verb->get_option("--fields"));
  verb->add_flag("--list", options->list, "Print the names of all fields");
  verb->footer(kWatchExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
