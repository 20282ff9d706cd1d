#include "host_tools/cli/line_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "host_tools/cli/reach_controller.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kLineExamples =
    "A board without an operating system has a serial line and no sockets. This verb makes, in "
    "the\n"
    "folder of --run-dir, the sockets that tactusd has: monitor, watch, set, enable and all other\n"
    "verbs of a running controller then work with the board, several at once. For one verb alone\n"
    "--serial does the same. It prints the board's lines of text. While it runs, the board takes "
    "its\n"
    "motors' power away if the line is lost. Ctrl-C ends it, and leaves the board as it is.\n"
    "\n"
    "Exit codes: 0 ended by the user or by --seconds; 2 the line was lost, or no board answers.\n"
    "\n"
    "Examples:\n"
    "  tactus line /dev/ttyACM0 --run-dir /tmp/board\n"
    "  tactus monitor --run-dir /tmp/board                   in another terminal\n"
    "  tactus line /dev/ttyUSB0:2000000 --run-dir /tmp/board --every 10\n"
    "  tactus line unix:board.sock --run-dir /tmp/board --record run.mcap --seconds 10\n"
    "  tactus line /dev/ttyACM0 --run-dir /tmp/board --record run.mcap --every 1 --wait 60\n"
    "  tactus replay run.mcap                                if it begins with the board's start";

// The verb's options as the user gave them.
struct LineOptions {
  std::string place;
  std::string run_dir = std::string(kDefaultRunDir);
  std::string record;
  // True: a recording may replace a file that is there.
  bool may_overwrite = false;
  std::string device_image;
  std::string scene_image;
  std::uint32_t every = 0;
  double seconds = 0.0;
  double wait_s = 3.0;
};

// A signal handler can reach nothing but globals.
std::atomic<bool> g_line_is_to_end{false};

void on_line_end(int /*signal*/) {
  g_line_is_to_end.store(true, std::memory_order_relaxed);
}

// Sets the flag after so long; destroying it ends the wait.
class Alarm {
 public:
  Alarm(double seconds, std::atomic<bool>& flag)
      : thread_([this, seconds, &flag](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          wake_.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
          flag.store(true, std::memory_order_relaxed);
        }) {}

 private:
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

void print_recorded(const LineGateway& gateway, const std::string& record) {
  const LineTelemetry& told = gateway.telemetry();
  if (told.ticks() == 0) {
    throw InputError(record + ": no tick came, so nothing is in it");
  }
  const std::uint64_t missing = gateway.missing_ticks();
  fmt::print("{}: {} ticks, {} to {}", record, told.ticks(), told.first_tick(), told.last_tick());
  if (told.first_tick() == 0 && missing == 0 && gateway.every() == 1) {
    fmt::print("; tactus replay {} compares them\n", record);
  } else if (told.first_tick() != 0) {
    fmt::print(
        "; no replay, since it began after the board's start: switch the board on "
        "after tactus line --wait 60 has begun\n");
  } else {
    fmt::print(
        "; no replay: one tick in {} was asked for, and {} of them are missing, since the "
        "line is too slow\n",
        gateway.every(), missing);
  }
}

void run_line_verb(const LineOptions& options) {
  check_recording_place(options.record, options.may_overwrite);
  GatewayOptions gateway_of = gateway_options(options.place);
  gateway_of.run_dir = options.run_dir;
  gateway_of.record = options.record;
  gateway_of.device_image = options.device_image;
  gateway_of.scene_image = options.scene_image;
  gateway_of.every = options.every;
  gateway_of.patience_s = options.wait_s;
  gateway_of.text = [](std::string_view line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  LineGateway gateway(std::move(gateway_of));
  const firmware::Hello& board = gateway.board();
  fmt::print(stderr,
             "tactus line: {}, profile {}, {} Hz, {} joints, one tick in {}; serving in {}; try: "
             "tactus monitor --run-dir {}; Ctrl-C ends\n",
             firmware::text_of(board.board), firmware::text_of(board.profile), board.rate_hz,
             board.joints, gateway.every(), options.run_dir, options.run_dir);
  run_gateway(gateway, options.seconds, options.record);
}

}  // namespace

void run_gateway(LineGateway& gateway, double seconds, const std::string& record) {
  struct sigaction action{};
  action.sa_handler = on_line_end;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
  {
    const std::unique_ptr<Alarm> alarm =
        seconds > 0.0 ? std::make_unique<Alarm>(seconds, g_line_is_to_end) : nullptr;
    gateway.run(g_line_is_to_end);
  }
  if (!record.empty()) {
    print_recorded(gateway, record);
  }
}

void add_line_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("line", "Serve a bare board's serial line to the other verbs");
  const auto options = std::make_shared<LineOptions>();
  verb->add_option("place", options->place,
                   "PATH[:BAUD] of the serial port, or unix:PATH of an emulator")
      ->required();
  verb->add_option("--run-dir", options->run_dir, "Folder of the sockets, which is made")
      ->envname("TACTUS_RUN_DIR")
      ->capture_default_str();
  verb->add_option("--record", options->record,
                   "Record to this file (.mcap or .csv); one that is there is kept");
  verb->add_flag("--overwrite", options->may_overwrite, "Let --record replace a file that is there")
      ->needs("--record");
  verb->add_option("--every", options->every,
                   "One tick in so many; default: as many as the line can carry");
  verb->add_option("--seconds", options->seconds, "End after so long")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--wait", options->wait_s,
                   "Seconds that the board's first answer may take, to switch it on meanwhile")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--device-image", options->device_image,
                   "The board's device image (.tactus), if it is not to come over the line");
  verb->add_option("--scene-image", options->scene_image, "The same for its scene");
  verb->footer(kLineExamples);
  verb->callback([options] { run_line_verb(*options); });
}

}  // namespace tactus::host
