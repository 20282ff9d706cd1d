// Opens a scene image from its file, for the verbs of `tactus` that run or show a scene: sim,
// touch, inspect, plot and bench. tactusd maps images by code of its own, without exceptions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "hal/linux/mapped_file.h"
#include "rendering/scene/scene_error.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// A mapped image. Views into it live as long as this object, wherever it is moved.
class MappedScene {
 public:
  // Maps and checks the image. Throws InputError that names the file if it cannot be read or the
  // check refuses it.
  explicit MappedScene(const std::filesystem::path& path);

  // Returns the checked image.
  [[nodiscard]] const rendering::SceneImage& image() const { return image_; }
  // Returns the bytes of the file.
  [[nodiscard]] std::span<const std::byte> bytes() const { return file_.bytes(); }

 private:
  hal::MappedFile file_;
  rendering::SceneImage image_;
};

// Returns the error in words, such as "object 2: triangle 17: vertex index is out of range; bake
// the scene again".
std::string explain(const rendering::SceneError& error);

}  // namespace tactus::host
