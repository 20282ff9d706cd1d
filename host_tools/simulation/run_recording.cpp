#include "host_tools/simulation/run_recording.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "host_tools/input_error.h"
#include "rendering/scene/image_format.h"

namespace tactus::host {
namespace {

std::size_t joints_of_device(const Simulation& simulation, std::size_t device) {
  return firmware::joint_count(simulation.config(device).mechanism);
}

std::int64_t due_ns(std::uint64_t tick, double rate_hz) {
  return std::llround(1e9 / rate_hz * static_cast<double>(tick));
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw InputError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(error)));
}

}  // namespace

firmware::RecordedTick recorded_tick(const Simulation& simulation, std::size_t device) {
  firmware::RecordedTick tick{.record = simulation.record(device)};
  tick.loop.scheduled_ns = due_ns(tick.record.tick, simulation.config(device).rate_hz);
  tick.joint_count = static_cast<std::uint32_t>(joints_of_device(simulation, device));
  return tick;
}

RunRecording::RunRecording(const std::filesystem::path& path, const Simulation& simulation,
                           std::span<const std::byte> scene, std::size_t device)
    : path_(path),
      place_(output_place(path, OutputKind::file)),
      rate_hz_(simulation.config().rate_hz),
      device_(device) {
  keep_images_safe(path);
  if (path.extension() == ".csv") {
    begin_csv(joints_of_device(simulation, device));
  } else {
    begin_mcap(simulation, scene);
  }
}

void RunRecording::begin_csv(std::size_t joints) {
  csv_ = std::make_unique<firmware::CsvWriter>();
  if (const int error = csv_->open(partial_of(place_).c_str(), joints); error != 0) {
    fail(path_, error);
  }
}

void RunRecording::begin_mcap(const Simulation& simulation, std::span<const std::byte> scene) {
  mcap_ = std::make_unique<firmware::McapWriter>();
  const std::string rate = fmt::format("{}", simulation.config().rate_hz);
  const std::string checksum = fmt::format("{:016x}", rendering::header_checksum(scene));
  const std::string number = fmt::format("{}", device_ + 1);
  const std::string count = fmt::format("{}", simulation.device_count());
  const std::array<firmware::MetadataEntry, 5> entries{{{"program", "tactus sim"},
                                                        {"rate_hz", rate},
                                                        {firmware::kSceneChecksumKey, checksum},
                                                        {firmware::kDeviceNumberKey, number},
                                                        {firmware::kDeviceCountKey, count}}};
  const auto info = std::span(entries).first(simulation.device_count() == 1 ? 3 : 5);
  if (const int error = mcap_->open(partial_of(place_).c_str(), 0, info); error != 0) {
    fail(path_, error);
  }
  std::array<std::byte, firmware::kMaxConfigBytes> config{};
  const std::size_t size = firmware::save_config(simulation.config(device_), config);
  mcap_->attach({.name = firmware::kConfigAttachment, .bytes = std::span(config).first(size)});
  mcap_->attach({.name = firmware::kSceneAttachment, .bytes = scene});
}

void RunRecording::add(const Simulation& simulation) {
  const firmware::RecordedTick tick = recorded_tick(simulation, device_);
  if (csv_) {
    csv_->add(tick);
  } else {
    mcap_->add(tick);
  }
}

void RunRecording::add(firmware::Explanation explanation) {
  if (mcap_) {
    explanation.time_ns = due_ns(explanation.tick, rate_hz_);
    mcap_->add(explanation);
  }
}

void RunRecording::close() {
  const std::filesystem::path partial = partial_of(place_);
  if (const int error = csv_ ? csv_->close() : mcap_->close(); error != 0) {
    ::unlink(partial.c_str());
    fail(path_, error);
  }
  if (::rename(partial.c_str(), place_.file.c_str()) != 0) {
    fail(path_, errno);
  }
}

}  // namespace tactus::host
