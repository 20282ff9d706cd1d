// tactusd: the controller on a Linux machine. It reads the images, opens the boards and then runs
// the loop (read -> controller -> write) at the device's rate, until a signal ends it. After a
// fault the loop goes on without force, because an operator may reset the fault.
#include <algorithm>
#include <atomic>
#include <cinttypes>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "firmware/linux/commands/command_queue.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/realtime/end_signals.h"
#include "firmware/linux/realtime/real_time.h"
#include "firmware/linux/realtime/service_notice.h"
#include "firmware/linux/realtime/timing_report.h"
#include "firmware/linux/realtime/watchdog_output.h"
#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/fault_messages.h"
#include "firmware/linux/tactusd/linux_boards.h"
#include "firmware/linux/tactusd/loop.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"
#include "firmware/linux/tactusd/program_hooks.h"
#include "firmware/linux/tactusd/real_time_thread.h"
#include "firmware/linux/tactusd/run_folder.h"
#include "firmware/linux/tactusd/run_inputs.h"
#include "firmware/linux/tactusd/run_telemetry.h"
#include "firmware/linux/tactusd/supervisor.h"
#include "hal/linux/system.h"

namespace tactus::firmware {
namespace {

// The exit codes; print_usage() explains them.
constexpr int kEnded = 0;
constexpr int kFaulted = 1;
constexpr int kCouldNotStart = 2;

// True after a signal that ends the program.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The signal that requested the stop; 0: none.
std::atomic<int> end_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_end_signal(int signal) {
  end_signal.store(signal, std::memory_order_relaxed);
  stop_requested.store(true, std::memory_order_relaxed);
}

std::uint64_t now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

// The objects that live as long as the program, in static storage.
struct Program {
  ExclusiveUse exclusive_use;
  RunInputs inputs;
  LinuxBoards boards;
  std::optional<drivers::ComposedDevice> device;
  Controller controller;
  LoopTiming timing;
  WatchdogOutput watchdog;
  CpuLatencyRequest cpu_latency;
  ServiceNotice notice;
  Supervisor supervisor;
  RunTelemetry telemetry;
  CommandQueue queue;
  CommandServer commands{queue, inputs.scenes()};
};

Program program;

// Takes the torque away at once. The handler of crashes calls it, too.
void stop_motors() {
  if (program.device) {
    program.device->stop();
  }
}

void on_flight_signal(int /*signal*/) {
  program.telemetry.ask_for_flight();
}

// Opens all boards and the watchdog's line. Returns the device, or null after it has printed why to
// stderr.
drivers::ComposedDevice* open_boards() {
  // Reading may take half of a period; the other half stays for the rest of the tick.
  const double half_period_s = 0.5 / program.inputs.config().controller.rate_hz;
  const double read_limit_s = std::min(program.inputs.config().read_limit_s, half_period_s);
  const auto read_limit_ns = static_cast<hal::TimeNs>(read_limit_s * 1e9);
  drivers::ComposedDevice& device = program.device.emplace(program.boards.clock(), read_limit_ns);
  const auto opened =
      program.boards.open(program.inputs.config(), program.inputs.falcon_firmware(), device);
  if (!opened) {
    complain(opened.error());
    return nullptr;
  }
  if (const auto watchdog = program.boards.open_watchdog(program.inputs.config(), program.watchdog);
      !watchdog) {
    complain(watchdog.error());
    return nullptr;
  }
  return &device;
}

// Runs the loop and stops the motors. Returns the exit code.
int run(drivers::ComposedDevice& device, const Options& options) {
  const double rate_hz = program.inputs.config().controller.rate_hz;
  LoopConfig config{.phase = loop_phase(rate_hz)};
  if (options.seconds > 0.0) {
    config.ticks = static_cast<std::uint64_t>(std::ceil(options.seconds * rate_hz));
  }
  program.timing.set_period(config.phase.period_ns);
  ProgramHooks hooks({.queue = program.queue,
                      .telemetry = program.telemetry,
                      .supervisor = program.supervisor,
                      .stop_requested = stop_requested},
                     device, options.enable);
  const LoopParts parts{.controller = program.controller,
                        .clock = program.boards.clock(),
                        .timing = program.timing,
                        .watchdog = program.watchdog};
  LoopEnd end = LoopEnd::ended;
  if (options.allow_inject) {
    InjectedDevice injected(device, program.queue.injector(), rate_hz, now_ns);
    end = run_loop(config, parts, injected, hooks);
  } else {
    end = run_loop(config, parts, device, hooks);
  }
  device.stop();
  end_real_time();
  return end == LoopEnd::faulted ? kFaulted : kEnded;
}

// Starts the messages to the service manager and to stderr. Returns false if there is no thread.
bool start_reporting() {
  if (const int failed = program.notice.open(); failed != 0) {
    std::fprintf(stderr, "tactusd: $NOTIFY_SOCKET: %s\n", std::strerror(failed));
  }
  const int failed = program.supervisor.start(program.notice);
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: no thread: %s\n", std::strerror(failed));
  }
  return failed == 0;
}

// Opens the command socket and the stop socket. Returns false after it has printed why to stderr.
bool start_commands(const Options& options) {
  const char* const folder = run_folder(options);
  std::array<char, kMaxMessage> path{};
  std::array<char, kMaxMessage> stop_path{};
  std::snprintf(path.data(), path.size(), "%s/command.sock", folder);
  std::snprintf(stop_path.data(), stop_path.size(), "%s/stop.sock", folder);
  program.queue.set_events(telemetry_events(program.telemetry.sinks()));
  RunHooks hooks = telemetry_hooks(program.telemetry.sinks());
  hooks.enable_refusal = program.inputs.enable_refusal();
  hooks.homing_hint = program.inputs.homing_hint();
  const auto started = program.commands.start({.socket_path = path.data(),
                                               .stop_socket_path = stop_path.data(),
                                               .group = options.group,
                                               .stop_priority = options.priority - 1,
                                               .allow_inject = options.allow_inject,
                                               .hooks = hooks});
  if (!started) {
    const ListenError& error = started.error();
    std::fprintf(stderr, "tactusd: no commands: %s: %.*s (%s)\n", path.data(), length(error.what),
                 error.what.data(), std::strerror(error.errno_value));
  }
  return started.has_value();
}

// Writes the histogram's file, or prints why it could not.
void write_timing(const char* path) {
  if (const int failed = write_histogram(path, program.timing); failed != 0) {
    std::fprintf(stderr, "tactusd: %s: cannot write: %s\n", path, std::strerror(failed));
  }
}

// Installs handlers for every signal that would end or stop the program. Call before there is
// torque. Returns false after it has printed why to stderr.
bool catch_signals() {
  int failed = catch_end_signals(on_end_signal, on_flight_signal);
  failed = failed != 0 ? failed : catch_crashes(stop_motors);
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: a signal would not stop the motors: %s\n",
                 std::strerror(failed));
  }
  return failed == 0;
}

// Prints the signal that ended the loop, if any. Call after the motors have been stopped.
void print_end_signal() {
  release_end_signals();
  if (const int signal = end_signal.load(std::memory_order_relaxed); signal != 0) {
    std::fprintf(stderr, "tactusd: ends at signal %d (%s)\n", signal, strsignal(signal));
  }
}

// Opens everything, runs the loop, and ends what was started. Returns the exit code.
int start_and_run(const Options& options) {
  program.controller.set_clock(now_ns);
  if (!take_run_folder(options, program.exclusive_use)) {
    return kCouldNotStart;
  }
  RunInputs& inputs = program.inputs;
  if (!inputs.load_device(options, program.controller) ||
      !inputs.load_scene(options, program.controller) || !inputs.load_falcon_firmware()) {
    return kCouldNotStart;
  }
  if (!program.exclusive_use.of_boards(inputs.config())) {
    return kCouldNotStart;
  }
  drivers::ComposedDevice* const device = open_boards();
  if (device == nullptr) {
    return kCouldNotStart;
  }
  if (!program.telemetry.start(options,
                               {.config = program.controller.config(),
                                .device = inputs.device(),
                                .scene = inputs.scenes().bytes()},
                               inputs.config().joint_count)) {
    return kCouldNotStart;
  }
  if (!start_commands(options) || !take_time(options, program.cpu_latency) || !start_reporting()) {
    return kCouldNotStart;
  }
  if (!catch_signals()) {
    return kCouldNotStart;
  }
  // The boards may put torque on the motors from here on, so the signals are caught by now.
  device->start();
  const int code = run(*device, options);
  print_end_signal();
  if (has_helper_crashed()) {
    explain_fault(program.controller.record().faults, *device);
    end_in_crash();
  }
  const bool has_ended = program.commands.stop();
  program.supervisor.stop();
  program.telemetry.stop(options);
  if (code == kFaulted) {
    explain_fault(program.controller.record().faults, *device);
  }
  print_timing(stderr, program.timing);
  std::fprintf(stderr, "hash of all ticks: %016" PRIx64 "\n",
               program.controller.record().state_hash);
  if (options.histogram != nullptr) {
    write_timing(options.histogram);
  }
  if (!has_ended) {
    std::fputs("tactusd: a file system has not answered the command thread; ends without it\n",
               stderr);
    std::fflush(nullptr);
    // A thread hangs in a system call and may use any object, so no destructor may run.
    std::_Exit(code);
  }
  return code;
}

}  // namespace
}  // namespace tactus::firmware

int main(int argc, char** argv) {
  tactus::firmware::Options options;
  if (!tactus::firmware::parse_options(argc, argv, options)) {
    return tactus::firmware::kCouldNotStart;
  }
  if (options.help) {
    tactus::firmware::print_usage(stdout);
    return tactus::firmware::kEnded;
  }
  return tactus::firmware::start_and_run(options);
}
