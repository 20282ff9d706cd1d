// tactusd: the controller on a Linux machine. It reads the images, opens the boards of all devices
// and then runs the loop (read -> controller -> write) at their rate, until a signal ends it. After
// a fault the loop goes on without force, because an operator may reset the fault.
#include <algorithm>
#include <array>
#include <atomic>
#include <cinttypes>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/realtime/end_signals.h"
#include "firmware/linux/realtime/real_time.h"
#include "firmware/linux/realtime/service_notice.h"
#include "firmware/linux/realtime/timing_report.h"
#include "firmware/linux/tactusd/device_set.h"
#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/loop.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"
#include "firmware/linux/tactusd/program_hooks.h"
#include "firmware/linux/tactusd/real_time_thread.h"
#include "firmware/linux/tactusd/run_folder.h"
#include "firmware/linux/tactusd/supervisor.h"
#include "hal/linux/gpio_lines.h"
#include "hal/linux/system.h"
#include "hal/linux/usb_endpoint.h"

namespace tactus::firmware {
namespace {

// The exit codes; print_usage() explains them.
constexpr int kEnded = 0;
constexpr int kFaulted = 1;
constexpr int kCouldNotStart = 2;

// The signal that ends the program; 0: none has come.
std::atomic<int> end_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_end_signal(int signal) {
  end_signal.store(signal, std::memory_order_relaxed);
}

std::uint64_t now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

// The objects that live as long as the program, in static storage.
struct Program {
  ExclusiveUse exclusive_use;
  SceneStore scenes;
  DeviceSet devices;
  LoopTiming timing;
  CpuLatencyRequest cpu_latency;
  ServiceNotice notice;
  Supervisor supervisor;
};

Program program;

// Takes the torque away at once. The handler of crashes calls it, too.
void stop_motors() {
  program.devices.stop_motors();
}

void on_flight_signal(int /*signal*/) {
  program.devices.flight().ask();
}

// Runs the loop with devices whose samples may be changed on the way.
LoopEnd run_injected(const LoopConfig& config, const LoopParts& parts, double rate_hz,
                     ProgramHooks& hooks) {
  using Injected = InjectedDevice<drivers::ComposedDevice>;
  std::array<std::optional<Injected>, rendering::kMaxTools> injected;
  std::array<Injected*, rendering::kMaxTools> devices{};
  const auto all = program.devices.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    devices[i] =
        &injected[i].emplace(all[i]->device(), all[i]->queue().injector(), rate_hz, now_ns);
  }
  return run_loop(config, parts, std::span<Injected* const>(devices).first(all.size()), hooks);
}

// Runs the loop and stops the motors. Returns the exit code.
int run(const Options& options) {
  const auto all = program.devices.all();
  const double rate_hz = all.front()->config().controller.rate_hz;
  LoopConfig config{.phase = loop_phase(rate_hz)};
  if (options.seconds > 0.0) {
    config.ticks = static_cast<std::uint64_t>(std::ceil(options.seconds * rate_hz));
  }
  program.timing.set_period(config.phase.period_ns);
  ProgramHooks hooks({.devices = all, .supervisor = program.supervisor, .end_signal = end_signal},
                     options.enable);
  std::array<WatchdogOutput*, rendering::kMaxTools> watchdogs{};
  std::array<drivers::ComposedDevice*, rendering::kMaxTools> devices{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    watchdogs[i] = &all[i]->watchdog();
    devices[i] = &all[i]->device();
  }
  const LoopParts parts{.controller = program.devices.controller(),
                        .clock = all.front()->clock(),
                        .timing = program.timing,
                        .watchdogs = std::span<WatchdogOutput* const>(watchdogs).first(all.size())};
  const LoopEnd end =
      options.allow_inject
          ? run_injected(config, parts, rate_hz, hooks)
          : run_loop(config, parts,
                     std::span<drivers::ComposedDevice* const>(devices).first(all.size()), hooks);
  stop_motors();
  end_real_time();
  return end == LoopEnd::faulted ? kFaulted : kEnded;
}

// Starts the messages to the service manager and to stderr. Returns false if there is no thread.
bool start_reporting() {
  if (const int failed = program.notice.open(); failed != 0) {
    std::fprintf(stderr, "tactusd: $NOTIFY_SOCKET: %s\n", std::strerror(failed));
  }
  const int failed = program.supervisor.start(program.notice, program.devices.all().size());
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: no thread: %s\n", std::strerror(failed));
  }
  return failed == 0;
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

// Prints how the loop kept its time, and the hash of each device's ticks.
void print_results(const Options& options) {
  print_timing(stderr, program.timing);
  const bool is_one = options.device_count == 1;
  for (std::size_t i = 0; i < options.device_count; ++i) {
    std::fprintf(stderr, "hash of all ticks%s%s: %016" PRIx64 "\n", is_one ? "" : " of ",
                 is_one ? "" : options.devices[i],
                 program.devices.controller().record(i).state_hash);
  }
  if (options.histogram != nullptr) {
    write_timing(options.histogram);
  }
}

// Opens everything, runs the loop, and ends what was started. Returns the exit code.
int start_and_run(const Options& options) {
  DeviceSet& devices = program.devices;
  if (!devices.make(options)) {
    return kCouldNotStart;
  }
  devices.controller().set_clock(now_ns);
  if (!take_run_folder(options, program.exclusive_use) ||
      !devices.open(options, program.exclusive_use, program.scenes) ||
      !devices.start_telemetry(options, program.scenes.bytes()) ||
      !devices.start_commands(options, program.scenes) || !name_devices(options) ||
      !take_time(options, program.cpu_latency) || !start_reporting() || !catch_signals()) {
    return kCouldNotStart;
  }
  // The boards may put torque on the motors from here on, so the signals are caught by now.
  devices.start_motors();
  const int code = run(options);
  print_end_signal();
  if (has_helper_crashed()) {
    devices.explain_faults(options);
    end_in_crash();
  }
  const bool have_ended = devices.stop_commands();
  program.supervisor.stop();
  devices.stop_telemetry();
  devices.explain_faults(options);
  print_results(options);
  if (!have_ended) {
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
  if (options.version) {
    std::printf("tactusd %s: CAN, serial ports, %s, %s\n", TACTUS_VERSION,
                tactus::hal::has_libusb() ? "USB" : "no USB (built without libusb-1.0)",
                tactus::hal::has_libgpiod() ? "GPIO" : "no GPIO (built without libgpiod 2)");
    return tactus::firmware::kEnded;
  }
  return tactus::firmware::start_and_run(options);
}
