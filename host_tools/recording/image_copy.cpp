#include "host_tools/recording/image_copy.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "firmware/linux/flight/attachments.h"
#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/input_error.h"
#include "rendering/scene/scene_error.h"

namespace tactus::host {

ImageCopy::ImageCopy(std::span<const std::byte> bytes)
    : lines_((bytes.size() + sizeof(Line) - 1) / sizeof(Line)), size_(bytes.size()) {
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(lines_)).begin());
}

ImageCopy ImageCopy::read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) {
    throw InputError(file + ": cannot read");
  }
  const std::string text = std::move(content).str();
  return ImageCopy(std::as_bytes(std::span(text)));
}

SceneCopy::SceneCopy(ImageCopy image, const std::string& name) : image_(std::move(image)) {
  if (image_.is_empty()) {
    return;
  }
  const auto opened = rendering::SceneImage::open(image_.bytes());
  if (!opened) {
    std::array<char, 256> room{};
    throw InputError(name + ": " + std::string(rendering::describe(opened.error(), room)));
  }
  scene_ = std::make_unique<rendering::SceneImage>(*opened);
}

// Each change of the scene adds an attachment, an empty one if the image was too large. The scene
// that the run began with, if it was attached at all, comes before them; so it is the surplus over
// the number of changes that decides whether it is there.
RecordedScenes recorded_scenes(const Recording& recording) {
  const auto inside = recording.attachments(firmware::kSceneAttachment);
  const auto changes = static_cast<std::size_t>(std::ranges::count(
      recording.events(), firmware::EventKind::scene, &firmware::TelemetryEvent::kind));
  const std::size_t later = std::min(inside.size(), changes);
  return {.first = inside.size() > changes ? inside.front() : std::span<const std::byte>{},
          .later = inside.last(later)};
}

}  // namespace tactus::host
