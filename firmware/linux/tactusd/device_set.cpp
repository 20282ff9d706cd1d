#include "firmware/linux/tactusd/device_set.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "firmware/device_file/together_checks.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/scene_input.h"

namespace tactus::firmware {

int DeviceSet::Further::make(std::size_t devices) {
  int failed = run.make(devices - 1);
  failed = failed != 0 ? failed : flight.make(devices - 1);
  failed = failed != 0 ? failed : controllers.make(devices - 1);
  failed = failed != 0 ? failed : tools.make(devices - 1);
  const std::size_t state_bytes =
      devices > 1 ? FlightRecorder::kStates * devices * kMaxCheckpointBytes : 0;
  return failed != 0 ? failed : states.make(state_bytes);
}

bool DeviceSet::make(const Options& options) {
  if (const int failed = further_.make(options.device_count); failed != 0) {
    std::fprintf(stderr, "tactusd: no memory for %zu devices: %s\n", options.device_count,
                 std::strerror(failed));
    return false;
  }
  controller_ = &made_controller_.emplace(further_.controllers.all(), further_.tools.all());
  all_[0] = &first_;
  for (std::size_t i = 1; i < options.device_count; ++i) {
    all_[i] = &further_.run.all()[i - 1];
  }
  count_ = options.device_count;
  return true;
}

bool DeviceSet::go_together(const Options& options) const {
  std::array<const DeviceConfig*, rendering::kMaxTools> configs{};
  std::ranges::transform(all(), configs.begin(),
                         [](const RunDevice* device) { return &device->config(); });
  Words words;
  const auto fits = check_together(std::span(configs).first(count_), words);
  if (!fits) {
    const auto& [device, refusal] = fits.error();
    const DeviceConfig& config = *configs[device];
    const std::string_view name = refusal.place == Place::axis
                                      ? config.axes[refusal.index].name
                                      : config.connections[refusal.index].name;
    std::fprintf(stderr, "tactusd: %s: '%.*s': %.*s %.*s\n", options.devices[device], length(name),
                 name.data(), length(refusal.key), refusal.key.data(), length(refusal.rule),
                 refusal.rule.data());
  }
  return fits.has_value();
}

bool DeviceSet::open(const Options& options, ExclusiveUse& exclusive_use, SceneStore& scenes) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (!all_[i]->load(options, i, *controller_)) {
      return false;
    }
  }
  return go_together(options) && load_scene(options, scenes, *controller_) &&
         std::ranges::all_of(all(),
                             [&exclusive_use](const RunDevice* device) {
                               return exclusive_use.of_boards(device->config());
                             }) &&
         std::ranges::all_of(
             all(), [&options](RunDevice* device) { return device->open_boards(options); });
}

bool DeviceSet::start_telemetry(const Options& options, std::span<const std::byte> scene) {
  for (RunDevice* const device : all()) {
    if (!device->start_telemetry(options, *controller_, scene)) {
      return false;
    }
  }
  for (std::size_t i = 1; i < count_; ++i) {
    RunTelemetry& telemetry = all_[i]->telemetry();
    FlightCompanion& companion = further_.flight.all()[i - 1];
    companions_[i - 1] = &telemetry.writer();
    flight_.accompany(companion, telemetry.flight_plan(options));
    telemetry.fly(companion);
  }
  if (count_ > 1) {
    flight_.use_room(further_.states.all());
  }
  RunTelemetry& first = first_.telemetry();
  first.tell(std::span(companions_).first(count_ - 1));
  first.fly(flight_);
  const int failed = flight_.start(first.flight_plan(options));
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: no thread for the flight recorder: %s\n", std::strerror(failed));
  }
  return failed == 0;
}

bool DeviceSet::start_commands(const Options& options, SceneStore& scenes) {
  return std::ranges::all_of(all(), [&](RunDevice* device) {
    return device->start_commands(options, device == &first_ ? &scenes : nullptr);
  });
}

void DeviceSet::start_motors() const {
  for (RunDevice* const device : all()) {
    device->device().start();
  }
}

void DeviceSet::stop_motors() const {
  for (RunDevice* const device : all()) {
    device->stop_motors();
  }
}

bool DeviceSet::stop_commands() const {
  bool have_ended = true;
  for (RunDevice* const device : all()) {
    have_ended = device->stop_commands() && have_ended;
  }
  return have_ended;
}

void DeviceSet::stop_telemetry() {
  flight_.stop();
  for (RunDevice* const device : all()) {
    device->telemetry().stop();
  }
}

void DeviceSet::explain_faults(const Options& options) const {
  for (std::size_t i = 0; i < count_; ++i) {
    all_[i]->explain_fault(*controller_, count_ > 1 ? options.devices[i] : "");
  }
}

}  // namespace tactus::firmware
