// The scene that a running controller has loaded: it tells the file, which is read here. One
// thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

class ServedScene {
 public:
  // Asks the controller whose first device has its sockets in the folder, and opens the scene.
  // Returns an empty text, or a sentence that says why there is no scene to show.
  std::string find(const std::filesystem::path& folder);

  // Returns the scene; nullptr without one.
  [[nodiscard]] const rendering::SceneImage* image() const {
    return scene_ == nullptr ? nullptr : &scene_->image();
  }

 private:
  // Its image has a megabyte, too much for the stack.
  std::unique_ptr<MappedScene> scene_;
};

}  // namespace tactus::host
