// A baked scene that Python holds: from a file, or from bytes in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host::python {

// The scene does not change, so any number of threads may use it at once.
class SceneFile {
 public:
  // Opens the image in a file. Throws InputError that names the file.
  explicit SceneFile(const std::string& path)
      : name_(path), mapped_(std::make_unique<MappedScene>(path)), image_(mapped_->image()) {}
  // Checks an image in memory and keeps it. Throws InputError.
  explicit SceneFile(std::vector<std::byte> bytes);

  [[nodiscard]] const rendering::SceneImage& image() const { return image_; }
  // Returns the file's name, or words that stand for it, for messages.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  // The views of `image_` lead into the file, or else into the bytes.
  std::unique_ptr<MappedScene> mapped_;
  std::vector<std::byte> bytes_;
  rendering::SceneImage image_;
};

}  // namespace tactus::host::python
