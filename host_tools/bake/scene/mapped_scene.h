// A scene image mapped from its file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "hal/linux/mapped_file.h"
#include "rendering/scene/scene_error.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Owns the mapping; the image's views live as long as this does, wherever it is moved.
class MappedScene {
 public:
  // Throws InputError, ready for the user, when the file cannot be read or the image is refused.
  explicit MappedScene(const std::filesystem::path& path);

  [[nodiscard]] const rendering::SceneImage& image() const { return image_; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return file_.bytes(); }

 private:
  hal::MappedFile file_;
  rendering::SceneImage image_;
};

// "object 2: triangle 17: vertex index is out of range; bake the scene again".
std::string explain(const rendering::SceneError& error);

}  // namespace tactus::host
