// The scene of a run that is drawn: the user's image, or the one inside the recording.
#pragma once

#include <optional>
#include <string>

#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/recording/image_copy.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

class PlotScene {
 public:
  // Opens the image file `scene`; with an empty name the scene that the recording `run` began with.
  // Throws InputError if the image cannot be used, or if the run has none inside.
  PlotScene(const std::string& scene, const std::string& run);

  [[nodiscard]] const rendering::SceneImage& image() const {
    return file_ ? file_->image() : *inside_.scene();
  }

 private:
  std::optional<MappedScene> file_;
  // Holds a scene if there is no file.
  SceneCopy inside_;
};

}  // namespace tactus::host
