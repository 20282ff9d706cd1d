// A recording with all that its run depended on: configuration, scene, and the state that it begins
// with.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host_tools/recording/recording.h"
#include "host_tools/replay/replayer.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Files to take instead of what is in the recording; empty for none.
struct RunImages {
  std::string device;
  std::string scene;
};

class RecordedRun {
 public:
  // Throws InputError if the recording, or an image that it needs to begin, cannot be read, is
  // missing or has another checksum than the run's.
  RecordedRun(const std::string& file, const RunImages& images);

  [[nodiscard]] Recording& ticks() { return recording_; }
  // Returns the run's setup. Its spans are valid as long as this object.
  [[nodiscard]] const ReplaySetup& setup() const { return setup_; }
  [[nodiscard]] const rendering::SceneImage* scene() const { return first_.scene.get(); }
  // Returns the scene that the run changed to before this tick, or nullptr if it did not. Throws
  // InputError if that image is not in the recording.
  [[nodiscard]] const rendering::SceneImage* changed_scene(std::uint64_t tick) const;
  // Returns the state with which the recording begins; empty if it begins with tick 0.
  [[nodiscard]] std::span<const std::byte> state() const;

 private:
  // A piece of memory that is aligned as images must be.
  struct alignas(rendering::kCacheLine) Line {
    std::array<std::byte, rendering::kCacheLine> bytes;
  };
  struct Image {
    std::vector<Line> lines;
    std::size_t size = 0;

    [[nodiscard]] std::span<const std::byte> bytes() const {
      return std::as_bytes(std::span(lines)).first(size);
    }
  };
  struct Scene {
    Image image;
    std::unique_ptr<rendering::SceneImage> scene;
  };
  struct SceneChange {
    std::uint64_t tick = 0;  // the first with this scene
    Scene to;                // none: its image is not in the recording
  };
  // An image that the run needs: its attachment, the key of its checksum, and the recording's copy.
  struct Wanted {
    std::string_view attachment;
    std::string_view checksum_key;
    std::span<const std::byte> inside;
  };
  [[nodiscard]] Image image(const std::string& file, const Wanted& wanted) const;
  static Image read(const std::string& file);
  static Image copy(std::span<const std::byte> bytes);
  void take_device(const std::string& file);
  static Scene open(Image image, const std::string& name);
  void take_scenes(const std::string& file);

  std::string name_;
  Recording recording_;
  Image device_image_;
  Scene first_;
  std::vector<SceneChange> changes_;
  ReplaySetup setup_;
};

}  // namespace tactus::host
