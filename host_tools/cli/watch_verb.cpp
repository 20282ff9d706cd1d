#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "host_tools/cli/monitor_verb.h"
#include "host_tools/input_error.h"
#include "host_tools/monitor/watch.h"
#include "host_tools/recording/live_reader.h"
#include "host_tools/remote/remote.h"

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
    "  tactus watch --fields mode,joint --seconds 1 | wc -l";

// The verb's options as the user gave them.
struct WatchOptions {
  std::string run_dir{kDefaultRunDir};
  std::vector<std::string> fields;
  std::uint64_t every = 1;
  double seconds = 0.0;
  bool list = false;
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

// Returns the line of a message; empty if it has none.
std::string line_of(WatchLines& lines, const LiveMessage& message) {
  if (const auto* tick = std::get_if<firmware::RecordedTick>(&message)) {
    return lines.line(*tick);
  }
  if (const auto* event = std::get_if<firmware::TelemetryEvent>(&message)) {
    return WatchLines::line(*event);
  }
  return {};
}

void print_run(const WatchOptions& options) {
  using std::chrono::steady_clock;
  // A closed pipe is then an error of the write that finds it, not a signal that ends the program.
  std::signal(SIGPIPE, SIG_IGN);
  LiveReader reader((std::filesystem::path(options.run_dir) / kLiveSocketFile).string());
  WatchLines lines(options.fields, options.every);
  const auto begin = steady_clock::now();
  const auto over = [&] {
    return options.seconds > 0.0 &&
           steady_clock::now() - begin >= std::chrono::duration<double>(options.seconds);
  };
  while (!reader.ended() && !over()) {
    const auto message = reader.next(std::chrono::milliseconds(0));
    if (message && !print_line(line_of(lines, *message))) {
      return;
    }
    if (!message) {
      // There is nothing more to read now, so the printed lines are shown.
      if (std::fflush(stdout) != 0 && errno == EPIPE) {
        return;
      }
      const auto next = reader.next(std::chrono::milliseconds(100));
      if (next && !print_line(line_of(lines, *next))) {
        return;
      }
    }
  }
  std::fflush(stdout);
}

void run(const WatchOptions& options) {
  if (!options.list) {
    print_run(options);
    return;
  }
  for (const std::string& field : watch_fields(drivers::kMaxJoints)) {
    fmt::print("{}\n", field);
  }
}

}  // namespace

void add_watch_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("watch", "Print a running controller's ticks as lines");
  const auto options = std::make_shared<WatchOptions>();
  verb->add_option("--run-dir", options->run_dir, "Folder of the controller's sockets")
      ->envname("TACTUS_RUN_DIR")
      ->capture_default_str();
  verb->add_option("--fields", options->fields, "Fields, apart by commas")->delimiter(',');
  verb->add_option("--every", options->every, "Every so many ticks")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb->add_option("--seconds", options->seconds, "End after so long; default: with the controller")
      ->check(CLI::NonNegativeNumber);
  verb->add_flag("--list", options->list, "Print the names of all fields");
  verb->footer(kWatchExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
