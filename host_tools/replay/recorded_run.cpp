#include "host_tools/replay/recorded_run.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "firmware/configuration/config_state.h"
#include "firmware/device/device_image.h"
#include "firmware/flight/attachments.h"
#include "firmware/telemetry/outputs/mcap_writer.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

std::string checksum_of(std::span<const std::byte> image) {
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), std::min(image.size(), sizeof header));
  std::ostringstream text;
  text.width(16);
  text.fill('0');
  text << std::hex << header.checksum;
  return text.str();
}

}  // namespace

RecordedRun::Image RecordedRun::copy(std::span<const std::byte> bytes) {
  Image image{.lines = std::vector<Line>((bytes.size() + sizeof(Line) - 1) / sizeof(Line)),
              .size = bytes.size()};
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(image.lines)).begin());
  return image;
}

RecordedRun::Image RecordedRun::read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) {
    throw InputError(file + ": cannot read");
  }
  const std::string text = std::move(content).str();
  return copy(std::as_bytes(std::span(text)));
}

// From the user's file, else out of the recording; empty if there is neither.
RecordedRun::Image RecordedRun::image(const std::string& file, std::string_view attachment,
                                      std::string_view checksum_key) const {
  Image found = file.empty() ? copy(recording_.attachment(attachment)) : read(file);
  const std::string_view wanted = recording_.info(checksum_key);
  if (found.size == 0) {
    if (!wanted.empty()) {
      throw InputError(name_ + ": it does not hold the image " + std::string(attachment) +
                       " that it was made with (checksum " + std::string(wanted) + "); give it");
    }
    return found;
  }
  const std::string checksum = checksum_of(found.bytes());
  if (!wanted.empty() && wanted != checksum) {
    throw InputError((file.empty() ? name_ : file) +
                     ": another image than the run's: its checksum is " + checksum +
                     ", and the recording was made with " + std::string(wanted));
  }
  return found;
}

RecordedRun::RecordedRun(const std::string& file, const RunImages& images)
    : name_(file), recording_(file) {
  take_device(images.device);
  take_scene(images.scene);
}

void RecordedRun::take_device(const std::string& file) {
  const auto config = recording_.attachment(firmware::kConfigAttachment);
  if (file.empty() && !config.empty()) {
    if (!firmware::read_config(config, setup_.config)) {
      throw InputError(name_ + ": its configuration is of another version of this program");
    }
    return;
  }
  device_image_ = image(file, firmware::kDeviceAttachment, firmware::kDeviceChecksumKey);
  if (device_image_.size == 0) {
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
    setup_.config.rate_hz = std::strtod(rate.c_str(), nullptr);  // tactusd --rate
  }
}

void RecordedRun::take_scene(const std::string& file) {
  scene_image_ = image(file, firmware::kSceneAttachment, firmware::kSceneChecksumKey);
  if (scene_image_.size == 0) {
    return;
  }
  auto opened = rendering::SceneImage::open(scene_image_.bytes());
  if (!opened) {
    throw InputError((file.empty() ? name_ + ": the scene's image" : file) + ": " +
                     std::string(rendering::describe(opened.error().fault)));
  }
  scene_ = std::make_unique<rendering::SceneImage>(*opened);
  setup_.objects = scene_->objects();
  setup_.world = {.tool_radius_m = scene_->tool_radius_m(), .effects = scene_->effects()};
}

std::span<const std::byte> RecordedRun::state() const {
  return recording_.attachment(firmware::kStateAttachment);
}

}  // namespace tactus::host
