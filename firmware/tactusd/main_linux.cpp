// tactusd: the controller on a Linux board. Reads the images, opens the boards, then ticks: read ->
// controller -> write, at the device's rate, until told to stop or a fault has stopped the motors.
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "firmware/control/run_tick.h"
#include "firmware/device/device_image.h"
#include "firmware/realtime/real_time.h"
#include "firmware/safety/faults.h"
#include "firmware/tactusd/certificate_words.h"
#include "firmware/tactusd/linux_boards.h"
#include "firmware/tactusd/mapped_file.h"
#include "firmware/tactusd/options.h"
#include "firmware/tactusd/run_log.h"
#include "hal/linux/system.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {
namespace {

constexpr int kEnded = 0;
constexpr int kFaulted = 1;
constexpr int kCouldNotStart = 2;
// After a fault the loop goes on for so long: the boards take the power away and hear what follows.
constexpr double kAfterFault_s = 0.2;
constexpr std::size_t kMostWords = 512;  // of one message

std::atomic<bool> told_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int /*signal*/) {
  told_to_stop.store(true, std::memory_order_relaxed);
}

std::uint64_t now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

// Everything that lives as long as the program; none of it on the heap.
struct Program {
  MappedFile device_file;
  MappedFile scene_file;
  MappedFile falcon_file;
  DeviceSections sections;
  DeviceConfig config;
  std::optional<rendering::SceneImage> scene;
  LinuxBoards boards;
  std::optional<drivers::ComposedDevice> device;
  Controller controller;
  RunLog log;
};

Program program;

int length(std::string_view text) {
  return static_cast<int>(text.size());
}

bool map(MappedFile& file, const char* path) {
  const int error = file.open(path);
  if (error != 0) {
    std::fprintf(stderr, "tactusd: %s: cannot read: %s\n", path, std::strerror(error));
  }
  return error == 0;
}

bool load_device(const Options& options) {
  if (!map(program.device_file, options.device)) {
    return false;
  }
  auto outcome = open_device_image(program.device_file.bytes(), program.sections);
  if (outcome) {
    outcome = read_device(program.sections, program.config);
  }
  if (!outcome) {
    const DeviceError& error = outcome.error();
    std::fprintf(stderr, "tactusd: %s: %.*s%s%.*s\n", options.device, length(error.key),
                 error.key.data(), error.key.empty() ? "" : " ", length(error.what),
                 error.what.data());
    return false;
  }
  std::array<char, kMostWords> words{};
  if (const auto warning = certificate_warning(program.config.certification, words);
      !warning.empty()) {
    std::fprintf(stderr, "tactusd: %s: warning: %.*s\n", options.device, length(warning),
                 warning.data());
  }
  program.config.controller.allow_uncertified = options.allow_uncertified;
  const auto valid = program.controller.configure(program.config.controller);
  if (!valid) {
    std::fprintf(stderr, "tactusd: %s: %.*s is out of range; bake the device again\n",
                 options.device, length(valid.error().field), valid.error().field.data());
  }
  program.controller.set_clock(now_ns);
  return valid.has_value();
}

void tell_refusal(const char* path, const rendering::SceneImage& scene,
                  const SceneRefusal& refusal) {
  const bool is_object = refusal.fault == SceneFault::uncertified &&
                         refusal.part.kind == UncertifiedPart::Kind::object;
  const std::string_view name =
      is_object ? scene.object_name(refusal.part.index) : std::string_view{};
  std::array<char, kMostWords> room{};
  const std::string_view words = refusal_words(refusal, name, room);
  std::fprintf(stderr, "tactusd: %s: %.*s\n", path, length(words), words.data());
}

bool load_scene(const Options& options) {
  if (options.scene == nullptr) {
    return true;
  }
  if (!map(program.scene_file, options.scene)) {
    return false;
  }
  const auto image = rendering::SceneImage::open(program.scene_file.bytes());
  if (!image) {
    const std::string_view what = rendering::describe(image.error().fault);
    std::fprintf(stderr, "tactusd: %s: %.*s\n", options.scene, length(what), what.data());
    return false;
  }
  const rendering::SceneImage& scene = program.scene.emplace(*image);
  const auto loaded = program.controller.load_scene(
      scene.objects(), {.tool_radius_m = scene.tool_radius_m(), .effects = scene.effects()});
  if (!loaded) {
    tell_refusal(options.scene, scene, loaded.error());
  }
  return loaded.has_value();
}

// The Falcon's firmware, if one is named.
bool load_falcon_firmware() {
  for (const ConnectionConfig& connection :
       std::span(program.config.connections).first(program.config.connection_count)) {
    const auto* falcon = std::get_if<FalconConnection>(&connection.line);
    if (falcon != nullptr && !falcon->firmware_file.empty()) {
      std::array<char, 512> path{};
      const std::size_t size = std::min(falcon->firmware_file.size(), path.size() - 1);
      std::memcpy(path.data(), falcon->firmware_file.data(), size);
      return map(program.falcon_file, path.data());
    }
  }
  return true;
}

// Null if a board does not open.
drivers::ComposedDevice* open_boards() {
  const auto read_limit_ns = static_cast<hal::TimeNs>(program.config.read_limit_s * 1e9);
  drivers::ComposedDevice& device = program.device.emplace(program.boards.clock(), read_limit_ns);
  const auto opened = program.boards.open(program.config, program.falcon_file.bytes(), device);
  if (!opened) {
    const OpenError& error = opened.error();
    const std::string_view code = hal::words(error.error.code);
    std::fprintf(stderr, "tactusd: connection '%.*s': %.*s (%.*s, error %d)\n",
                 length(error.connection), error.connection.data(), length(error.what),
                 error.what.data(), length(code), code.data(), error.error.errno_value);
    return nullptr;
  }
  return &device;
}

// The request of this tick: --enable homes and enables, a signal disables.
Request wish(const Options& options, bool stopping) {
  const Mode mode = program.controller.mode();
  if (stopping) {
    return mode == Mode::active ? Request::disable : Request::none;
  }
  if (!options.enable) {
    return Request::none;
  }
  return mode == Mode::init ? Request::home : mode == Mode::ready ? Request::enable : Request::none;
}

void log_tick(const drivers::ComposedDevice& device, const hal::Wake& wake) {
  LoggedTick tick{.scheduled_ns = wake.scheduled_ns,
                  .woke_ns = wake.woke_ns,
                  .done_ns = hal::monotonic_now_ns(),
                  .sample_ns = device.encoder_sample(0).time_ns,
                  .record = program.controller.record()};
  for (std::size_t i = 0; i < device.joint_count(); ++i) {
    tick.shaft_rad[i] = device.encoder_sample(i).position_rad;
    tick.torque_Nm[i] = device.commanded_torque_Nm(i);
  }
  program.log.add(tick);
}

void tell_mode(Mode mode) {
  const std::string_view name = mode_name(mode);
  std::fprintf(stderr, "tactusd: %.*s\n", length(name), name.data());
}

// The loop. Nothing in it allocates or waits but for the boards' transfers and the phase.
int run(drivers::ComposedDevice& device, const Options& options) {
  hal::LinuxClock& clock = program.boards.clock();
  const double rate_hz = program.config.controller.rate_hz;
  const hal::Phase phase{.period_ns = static_cast<hal::TimeNs>(1e9 / rate_hz), .offset_ns = 0};
  const double limit = options.seconds > 0.0 ? std::ceil(options.seconds * rate_hz) : 1e18;
  double ticks_after_fault = 0.0;
  Mode told = program.controller.mode();
  bool stopping = false;
  hal::Wake wake = clock.sleep_until(hal::next_instant_ns(phase, clock.now_ns()));
  for (auto left = static_cast<std::uint64_t>(limit); left > 0; --left) {
    stopping = stopping || told_to_stop.load(std::memory_order_relaxed);
    run_tick(program.controller, device, wish(options, stopping));
    log_tick(device, wake);
    const Mode mode = program.controller.mode();
    if (mode != told && mode != Mode::active) {
      tell_mode(mode);
    }
    told = mode;
    ticks_after_fault = mode == Mode::fault ? ticks_after_fault + 1.0 : 0.0;
    if (ticks_after_fault > kAfterFault_s * rate_hz || (stopping && mode != Mode::active)) {
      break;
    }
    wake = clock.sleep_to_phase(phase, wake);
  }
  device.stop();
  return program.controller.mode() == Mode::fault ? kFaulted : kEnded;
}

void explain_fault(const drivers::ComposedDevice& device) {
  for (const FaultText& text : kFaultTexts) {
    if ((program.controller.record().faults & text.bit) != 0) {
      std::fprintf(stderr, "tactusd: fault %d %.*s: %.*s\n", fault_code(text.bit),
                   length(text.name), text.name.data(), length(text.meaning), text.meaning.data());
    }
  }
  const auto [joint, trouble] = device.trouble();
  if (trouble) {
    std::fprintf(stderr, "tactusd: joint '%.*s': %.*s (code 0x%x); %.*s\n", length(joint),
                 joint.data(), length(trouble.what), trouble.what.data(), trouble.code,
                 length(trouble.remedy), trouble.remedy.data());
  }
}

int start_and_run(const Options& options) {
  if (!load_device(options) || !load_scene(options) || !load_falcon_firmware()) {
    return kCouldNotStart;
  }
  drivers::ComposedDevice* const device = open_boards();
  if (device == nullptr) {
    return kCouldNotStart;
  }
  const double ticks = std::ceil(options.seconds * program.config.controller.rate_hz);
  if (options.record != nullptr && !program.log.reserve(static_cast<std::size_t>(ticks))) {
    std::fputs("tactusd: no memory for that many seconds of --record\n", stderr);
    return kCouldNotStart;
  }
  RealTimeError error;
  if (!become_real_time(options.priority, error)) {
    std::fprintf(stderr, "tactusd: %.*s (%s); %.*s\n", length(error.what), error.what.data(),
                 std::strerror(error.errno_value), length(error.remedy), error.remedy.data());
    if (!options.allow_non_realtime) {
      return kCouldNotStart;
    }
  }
  struct sigaction action{};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);

  device->start();
  const int code = run(*device, options);
  if (code == kFaulted) {
    explain_fault(*device);
  }
  if (options.record != nullptr) {
    if (const int failed = program.log.write_csv(options.record, program.config.joint_count);
        failed != 0) {
      std::fprintf(stderr, "tactusd: %s: cannot write: %s\n", options.record,
                   std::strerror(failed));
    }
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
