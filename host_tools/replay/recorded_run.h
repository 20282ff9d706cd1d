// A recording together with everything that its run depended on: the configuration, the scene, and
// the controller's state before the first recorded tick. `tactus replay` and the tests build on it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host_tools/recording/image_copy.h"
#include "host_tools/recording/recording.h"
#include "host_tools/replay/replayer.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Image files that replace those inside the recording; an empty name takes the recording's own.
struct RunImages {
  std::string device;
  std::string scene;
};

// A run that can be replayed. It holds the images in memory, aligned as the controller needs them.
class RecordedRun {
 public:
  // Opens the recording `file`. Throws InputError if the recording or an image that it needs at its
  // beginning cannot be read or is missing, or if an image has another checksum than the run noted.
  RecordedRun(const std::string& file, const RunImages& images);

  // Returns the name of the recording's file.
  [[nodiscard]] const std::string& name() const { return name_; }
  // Returns the recording, to step through its ticks.
  [[nodiscard]] Recording& ticks() { return recording_; }
  // Returns the run's setup. Its spans are valid as long as this object.
  [[nodiscard]] const ReplaySetup& setup() const { return setup_; }
  // Returns the scene that the run began with, or nullptr if it had none.
  [[nodiscard]] const rendering::SceneImage* scene() const { return first_.scene(); }
  // Returns the scene that the run changed to before this tick, or nullptr if it kept its scene.
  // Throws InputError if that image is not in the recording.
  [[nodiscard]] const rendering::SceneImage* changed_scene(std::uint64_t tick) const;
  // Returns the bytes of Controller::save() before the first recorded tick; empty if the recording
  // begins with tick 0.
  [[nodiscard]] std::span<const std::byte> state() const;

 private:
  struct SceneChange {
    // The first tick with the new scene.
    std::uint64_t tick = 0;
    // No scene if the image was too large for the recording.
    SceneCopy to;
  };
  // An image that the run needs: the name of its attachment, the key of its checksum in the run's
  // information, and the recording's own copy, which may be empty.
  struct Wanted {
    std::string_view attachment;
    std::string_view checksum_key;
    std::span<const std::byte> inside;
  };
  // Returns the user's file if one is named, else the recording's copy; an empty image if there is
  // neither and the run noted no checksum. Throws InputError.
  [[nodiscard]] ImageCopy image(const std::string& file, const Wanted& wanted) const;
  // Takes the configuration: from the user's file, else from the recorded configuration, else from
  // the recorded device image.
  void take_device(const std::string& file);
  // Takes the first scene and all later ones.
  void take_scenes(const std::string& file);

  std::string name_;
  Recording recording_;
  ImageCopy device_image_;
  SceneCopy first_;
  std::vector<SceneChange> changes_;
  ReplaySetup setup_;
};

}  // namespace tactus::host
