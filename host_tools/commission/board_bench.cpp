#include "host_tools/commission/board_bench.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <optional>

#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/realtime/end_signals.h"
#include "firmware/linux/realtime/real_time.h"
#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/linux_boards.h"
#include "firmware/linux/tactusd/loop.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A signal handler can reach nothing but globals: the signal that arrived, and the device that a
// crash must stop.
std::atomic<int> ended_by{0};
drivers::ComposedDevice* stopped_in_a_crash = nullptr;

// Notes the signal; wait() then throws, so that the destructor stops the device.
void on_signal(int signal) {
  ended_by.store(signal, std::memory_order_relaxed);
}

// Takes the motors' power away before the process dies.
void stop_in_a_crash() {
  if (stopped_in_a_crash != nullptr) {
    stopped_in_a_crash->stop();
  }
}

// Returns true if the person has pressed Enter, or standard input has ended.
bool has_typed_a_line() {
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (::poll(&input, 1, 0) <= 0) {
    return false;
  }
  std::array<char, 256> line{};
  return ::read(STDIN_FILENO, line.data(), line.size()) >= 0;
}

// Returns the words that ask the person for the task.
const char* words_of(HandTask task) {
  switch (task) {
    case HandTask::hold_for_homing:
      return "Bring each joint to where its reference is and hold it there (see device.toml).";
    case HandTask::move_everywhere:
      return "The motors are off. Move the handle to every end of its travel.";
    case HandTask::let_go:
      break;
  }
  return "Let go of the handle, and keep hands and hair away. An arm that sinks: support it so "
         "that it hangs at rest.";
}

// The bench of a real device: opens its boards, and runs the loop in this process with real-time
// priority. Only one program may have the device.
class BoardBench final : public Bench {
 public:
  BoardBench(const firmware::DeviceConfig& config, std::span<const std::byte> falcon_firmware,
             const BoardBenchOptions& options)
      : options_(options),
        phase_(firmware::loop_phase(config.controller.rate_hz)),
        device_(boards_.clock(), read_limit_ns(config)) {
    if (!exclusive_use_.of_boards(config)) {
      throw InputError("the device is in use; end that program first");
    }
    if (const auto opened = boards_.open(config, falcon_firmware, device_); !opened) {
      const firmware::OpenError& error = opened.error();
      throw InputError(fmt::format("connection '{}': {} ({}, {})", error.connection, error.what,
                                   hal::words(error.error.code),
                                   std::strerror(error.error.errno_value)));
    }
    (void)firmware::catch_end_signals(on_signal, on_signal);
    stopped_in_a_crash = &device_;
    (void)firmware::catch_crashes(stop_in_a_crash);
    firmware::RealTimeError error;
    if (!firmware::become_real_time({.priority = options.priority}, error)) {
      fmt::print(stderr, "tactus commission: warning: {} ({}): ticks may be late\n", error.what,
                 std::strerror(error.errno_value));
    }
    device_.start();
    wake_ = boards_.clock().sleep_until(hal::next_instant_ns(phase_, boards_.clock().now_ns()));
  }
  ~BoardBench() override {
    device_.stop();
    stopped_in_a_crash = nullptr;
    firmware::end_real_time();
  }
  BoardBench(const BoardBench&) = delete;
  BoardBench& operator=(const BoardBench&) = delete;

  void read(drivers::JointSample& sample) override { device_.read(sample); }
  void write(const drivers::JointCommand& command) override { (void)device_.write(command); }

  void wait() override {
    if (const int signal = ended_by.load(std::memory_order_relaxed); signal != 0) {
      throw InputError(
          fmt::format("ended by signal {}; the motors' power is off", ::strsignal(signal)));
    }
    wake_ = boards_.clock().sleep_to_phase(phase_, wake_);
  }

  void ask(HandTask task) override {
    asked_ns_ = boards_.clock().now_ns();
    if (!options_.unattended) {
      fmt::print(stderr, "{} Then press Enter.\n", words_of(task));
    }
  }

  bool is_at_work(HandTask task) override {
    if (!options_.unattended) {
      return !has_typed_a_line();
    }
    const double passed_s = 1e-9 * static_cast<double>(boards_.clock().now_ns() - asked_ns_);
    return task == HandTask::move_everywhere && passed_s < options_.travel_s;
  }

  [[nodiscard]] std::string trouble() const override {
    const auto [joint, trouble] = device_.trouble();
    return trouble ? fmt::format("joint '{}': {} (code {:#x}); {}", joint, trouble.what,
                                 trouble.code, trouble.remedy)
                   : std::string();
  }

 private:
  // Returns the longest time that a read may wait, ns. Half of every period is kept for the rest of
  // the tick, as in tactusd.
  static hal::TimeNs read_limit_ns(const firmware::DeviceConfig& config) {
    const double half_period_s = 0.5 / config.controller.rate_hz;
    return static_cast<hal::TimeNs>(1e9 * std::min(config.read_limit_s, half_period_s));
  }

  BoardBenchOptions options_;
  hal::Phase phase_;
  firmware::ExclusiveUse exclusive_use_;
  firmware::LinuxBoards boards_;
  drivers::ComposedDevice device_;
  hal::Wake wake_;
  hal::TimeNs asked_ns_ = 0;
};

}  // namespace

std::unique_ptr<Bench> open_board_bench(const firmware::DeviceConfig& config,
                                        std::span<const std::byte> falcon_firmware,
                                        const BoardBenchOptions& options) {
  return std::make_unique<BoardBench>(config, falcon_firmware, options);
}

}  // namespace tactus::host
