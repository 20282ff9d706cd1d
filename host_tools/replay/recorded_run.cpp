#include "host_tools/replay/recorded_run.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iomanip>
#include <memory>
#include <sstream>

#include "firmware/configuration/config_state.h"
#include "firmware/device_file/device_image.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/mcap_writer.h"
#include "host_tools/input_error.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

// Returns the checksum as the recorder writes it: 16 hexadecimal digits.
std::string checksum_text(std::span<const std::byte> image) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << rendering::header_checksum(image);
  return text.str();
}

}  // namespace

ImageCopy RecordedRun::image(const std::string& file, const Wanted& wanted) const {
  ImageCopy found = file.empty() ? ImageCopy(wanted.inside) : ImageCopy::read(file);
  const std::string known(recording_.info(wanted.checksum_key));
  if (found.is_empty()) {
    if (!known.empty()) {
      throw InputError(name_ + ": it does not hold the image " + std::string(wanted.attachment) +
                       " that it was made with (checksum " + known + "); give it");
    }
    return found;
  }
  const std::string checksum = checksum_text(found.bytes());
  if (!known.empty() && known != checksum) {
    throw InputError((file.empty() ? name_ : file) +
                     ": another image than the run's: its checksum is " + checksum +
                     ", and the recording was made with " + known);
  }
  return found;
}

RecordedRun::RecordedRun(const std::string& file, const RunImages& images)
    : name_(file), recording_(file) {
  take_device(images.device);
  take_scenes(images.scene);
}

void RecordedRun::take_device(const std::string& file) {
  const auto config = recording_.attachment(firmware::kConfigAttachment);
  if (file.empty() && !config.empty()) {
    if (!firmware::read_config(config, setup_.config)) {
      throw InputError(name_ + ": its configuration is of another version of this program");
    }
    return;
  }
  device_image_ = image(file, {.attachment = firmware::kDeviceAttachment,
                               .checksum_key = firmware::kDeviceChecksumKey,
                               .inside = recording_.attachment(firmware::kDeviceAttachment)});
  if (device_image_.is_empty()) {
    throw InputError(name_ + ": it does not say what device it is of; give --device D.tactus");
  }
  const auto sections = std::make_unique<firmware::DeviceSections>();
  const auto device = std::make_unique<firmware::DeviceConfig>();
  auto outcome = firmware::open_device_image(device_image_.bytes(), *sections);
  if (outcome) {
    outcome = firmware::read_device(*sections, *device);
  }
  if (!outcome) {
    throw InputError((file.empty() ? name_ + ": the device's image" : file) + ": " +
                     std::string(outcome.error().what));
  }
  setup_.config = device->controller;
  const std::string rate(recording_.info("rate_hz"));
  if (!rate.empty()) {
    // `tactusd --rate` replaces the rate of the device's file, and the run notes the rate that it
    // had.
    setup_.config.rate_hz = std::strtod(rate.c_str(), nullptr);
  }
}

void RecordedRun::take_scenes(const std::string& file) {
  const RecordedScenes inside = recorded_scenes(recording_);
  const std::string own_name = name_ + ": the scene's image";
  for (const firmware::TelemetryEvent& event : recording_.events()) {
    if (event.kind == firmware::EventKind::scene) {
      changes_.push_back({.tick = event.tick});
    }
  }
  for (std::size_t i = 0; i < inside.later.size(); ++i) {
    changes_[i].to = SceneCopy(ImageCopy(inside.later[i]), own_name);
  }
  first_ = SceneCopy(image(file, {.attachment = firmware::kSceneAttachment,
                                  .checksum_key = firmware::kSceneChecksumKey,
                                  .inside = inside.first}),
                     file.empty() ? own_name : file);
  if (scene() != nullptr) {
    setup_.objects = scene()->objects();
    setup_.world = rendering::world_of(*scene());
  }
}

const rendering::SceneImage* RecordedRun::changed_scene(std::uint64_t tick) const {
  const auto change = std::ranges::find(changes_, tick, &SceneChange::tick);
  if (change == changes_.end()) {
    return nullptr;
  }
  if (change->to.scene() == nullptr) {
    throw InputError(name_ + ": before tick " + std::to_string(tick) +
                     " the scene was changed, and the image " +
                     std::string(firmware::kSceneAttachment) +
                     " of the new one is not inside: nothing can be replayed beyond that");
  }
  return change->to.scene();
}

std::span<const std::byte> RecordedRun::state() const {
  return recording_.attachment(firmware::kStateAttachment);
}

}  // namespace tactus::host
