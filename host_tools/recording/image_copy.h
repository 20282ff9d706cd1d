// Copies of the images inside a recording, in memory that is aligned as an image needs it: inside
// the file they begin anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/recording/recording.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// The bytes of an image, which stay where they are when this is moved.
class ImageCopy {
 public:
  ImageCopy() = default;
  explicit ImageCopy(std::span<const std::byte> bytes);
  // Reads a file. Throws InputError that names it.
  static ImageCopy read(const std::string& file);

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return std::as_bytes(std::span(lines_)).first(size_);
  }
  [[nodiscard]] bool is_empty() const { return size_ == 0; }

 private:
  // One cache line of memory.
  struct alignas(rendering::kCacheLine) Line {
    std::array<std::byte, rendering::kCacheLine> bytes;
  };

  std::vector<Line> lines_;
  // The length in bytes, without the padding of the last line.
  std::size_t size_ = 0;
};

// A scene and the image that it points into.
class SceneCopy {
 public:
  // Holds no scene.
  SceneCopy() = default;
  // Opens the image; an empty one gives no scene. Throws InputError that begins with `name` if the
  // image is refused.
  SceneCopy(ImageCopy image, const std::string& name);

  // Returns the scene, or nullptr if there is none.
  [[nodiscard]] const rendering::SceneImage* scene() const { return scene_.get(); }

 private:
  ImageCopy image_;
  std::unique_ptr<rendering::SceneImage> scene_;
};

// The scene images inside a recording. All are empty where an image was too large for it.
struct RecordedScenes {
  // The one that the run began with.
  std::span<const std::byte> first;
  // The ones that it changed to, in the order of its events of kind scene.
  std::span<const std::span<const std::byte>> later;
};
RecordedScenes recorded_scenes(const Recording& recording);

}  // namespace tactus::host
