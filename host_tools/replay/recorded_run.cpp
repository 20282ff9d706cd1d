#include "host_tools/replay/recorded_run.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iomanip>
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

RecordedRun::Image RecordedRun::image(const std::string& file, const Wanted& wanted) const {
  Image found = file.empty() ? copy(wanted.inside) : read(file);
  const std::string known(recording_.info(wanted.checksum_key));
  if (found.size == 0) {
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
    // `tactusd --rate` replaces the rate of the device's file, and the run notes the rate that it
    // had.
    setup_.config.rate_hz = std::strtod(rate.c_str(), nullptr);
  }
}

RecordedRun::Scene RecordedRun::open(Image image, const std::string& name) {
  Scene scene{.image = std::move(image)};
  if (scene.image.size == 0) {
    return scene;
  }
  auto opened = rendering::SceneImage::open(scene.image.bytes());
  if (!opened) {
    std::array<char, 256> room{};
    throw InputError(name + ": " + std::string(rendering::describe(opened.error(), room)));
  }
  scene.scene = std::make_unique<rendering::SceneImage>(*opened);
  return scene;
}

// Each change of the scene adds an attachment, an empty one if the image was too large. The scene
// that the run began with, if it was attached at all, comes before them; so it is the surplus over
// the number of changes that decides whether it is there.
void RecordedRun::take_scenes(const std::string& file) {
  const auto inside = recording_.attachments(firmware::kSceneAttachment);
  const std::string own_name = name_ + ": the scene's image";
  for (const firmware::TelemetryEvent& event : recording_.events()) {
    if (event.kind == firmware::EventKind::scene) {
      changes_.push_back({.tick = event.tick});
    }
  }
  const bool has_first = inside.size() > changes_.size();
  const std::size_t behind_first = inside.size() - std::min(inside.size(), changes_.size());
  for (std::size_t i = 0; behind_first + i < inside.size(); ++i) {
    changes_[i].to = open(copy(inside[behind_first + i]), own_name);
  }
  first_ = open(image(file, {.attachment = firmware::kSceneAttachment,
                             .checksum_key = firmware::kSceneChecksumKey,
                             .inside = has_first ? inside.front() : std::span<const std::byte>{}}),
                file.empty() ? own_name : file);
  if (first_.scene != nullptr) {
    setup_.objects = first_.scene->objects();
    setup_.world = rendering::world_of(*first_.scene);
  }
}

const rendering::SceneImage* RecordedRun::changed_scene(std::uint64_t tick) const {
  const auto change = std::ranges::find(changes_, tick, &SceneChange::tick);
  if (change == changes_.end()) {
    return nullptr;
  }
  if (change->to.scene == nullptr) {
    throw InputError(name_ + ": before tick " + std::to_string(tick) +
                     " the scene was changed, and the image " +
                     std::string(firmware::kSceneAttachment) +
                     " of the new one is not inside: nothing can be replayed beyond that");
  }
  return change->to.scene.get();
}

std::span<const std::byte> RecordedRun::state() const {
  return recording_.attachment(firmware::kStateAttachment);
}

}  // namespace tactus::host
