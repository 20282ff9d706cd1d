#include "host_tools/cli/served_device.h"

#include <fmt/format.h>

#include <cstring>
#include <ctime>
#include <span>

#include "firmware/linux/flight/attachments.h"
#include "hal/linux/system.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "rendering/scene/image_format.h"

namespace tactus::host {
namespace {

// Throws InputError with the system's reason.
[[noreturn]] void refuse_folder(const std::string& path, std::string_view what, int error) {
  throw InputError(
      fmt::format("{}: {} ({}); --run-dir names another folder", path, what, std::strerror(error)));
}

}  // namespace

void ServedTelemetry::start(const Simulation& simulation, std::size_t device,
                            const firmware::SceneStore& scenes, double rate_hz,
                            const ServeOptions& options) {
  device_ = device;
  explanations_.set_device(device);
  const std::string socket =
      (run_folder_of(options.run_dir, device + 1) / "telemetry.sock").string();
  if (const int error = writer_->open_live_socket(socket.c_str()); error != 0) {
    refuse_folder(socket, "cannot be opened", error);
  }
  if (const int error = open_udp(options.udp_port, rate_hz); error != 0) {
    throw InputError(fmt::format("--udp-json {}: {}", options.udp_port, std::strerror(error)));
  }
  describe(simulation, scenes, rate_hz);
  const std::string file = file_of_tool(options.record, device).string();
  if (const int error = file.empty() ? 0 : writer_->record(file.c_str()); error != 0) {
    throw InputError(fmt::format("{}: {}", file, std::strerror(error)));
  }
  if (const int error = writer_->start(); error != 0) {
    refuse_folder(socket, "no thread", error);
  }
}

int ServedTelemetry::open_udp(std::uint16_t first_port, double rate_hz) {
  if (first_port == 0) {
    return 0;
  }
  return writer_->open_udp(static_cast<std::uint16_t>(first_port + device_), rate_hz);
}

void ServedTelemetry::publish(firmware::Controller& controller, const hal::Wake& wake) {
  firmware::RecordedTick recorded{.record = controller.record(device_),
                                  .loop = {.scheduled_ns = wake.scheduled_ns,
                                           .woke_ns = wake.woke_ns,
                                           .done_ns = hal::monotonic_now_ns(),
                                           .sample_ns = wake.woke_ns},
                                  .joint_count = static_cast<std::uint32_t>(joints_)};
  recorded.shaft_rad = recorded.record.joint_position;
  recorded.torque_Nm = recorded.record.joint_effort;
  writer_->publish(recorded);
  explanations_.after_tick(controller, wake.scheduled_ns, *writer_);
  places_.after_tick(controller, wake.scheduled_ns, *writer_);
}

void ServedTelemetry::stop() {
  if (const int error = writer_->stop(); error != 0) {
    throw InputError(fmt::format("the recording ended early: {}", std::strerror(error)));
  }
}

void ServedTelemetry::describe(const Simulation& simulation, const firmware::SceneStore& scenes,
                               double rate_hz) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  joints_ = firmware::joint_count(simulation.config(device_).mechanism);
  words_.rate = fmt::format("{}", rate_hz);
  words_.joints = fmt::format("{}", joints_);
  words_.checksum = fmt::format("{:016x}", rendering::header_checksum(scenes.bytes()));
  words_.number = fmt::format("{}", device_ + 1);
  words_.count = fmt::format("{}", simulation.device_count());
  words_.entries = {{{"program", "tactus sim"},
                     {"rate_hz", words_.rate},
                     {"joints", words_.joints},
                     {firmware::kSceneChecksumKey, words_.checksum},
                     {firmware::kDeviceNumberKey, words_.number},
                     {firmware::kDeviceCountKey, words_.count}}};
  constexpr std::size_t kOfOneDevice = 4;
  const std::span<const firmware::MetadataEntry> entries(words_.entries);
  writer_->describe({.info = simulation.device_count() > 1 ? entries : entries.first(kOfOneDevice),
                     .joints = joints_,
                     .clock_offset_ns = hal::to_ns(now) - hal::monotonic_now_ns()});
  writer_->attach({.name = firmware::kSceneAttachment, .bytes = scenes.bytes()});
  const std::size_t size = firmware::save_config(simulation.config(device_), config_);
  writer_->attach({.name = firmware::kConfigAttachment, .bytes = std::span(config_).first(size)});
}

ServedDevice::ServedDevice(std::size_t number, const std::filesystem::path& run_dir)
    : number_(number), folder_(run_folder_of(run_dir, number + 1)) {
  queue_->set_device(number);
  std::filesystem::create_directories(folder_);
}

void ServedDevice::start_commands(firmware::SceneStore* scenes, bool allow_inject) {
  const std::string socket = (folder_ / kCommandSocket).string();
  const std::string stop_socket = (folder_ / kStopSocket).string();
  queue_->set_events(firmware::telemetry_events(telemetry_.sinks()));
  server_ = std::make_unique<firmware::CommandServer>(*queue_, scenes);
  const auto started = server_->start({.socket_path = socket.c_str(),
                                       .stop_socket_path = stop_socket.c_str(),
                                       .allow_inject = allow_inject,
                                       .hooks = firmware::telemetry_hooks(telemetry_.sinks())});
  if (!started) {
    refuse_folder(socket, started.error().what, started.error().errno_value);
  }
}

}  // namespace tactus::host
