// A controller that is started from a device image and a scene image, both used where they lie, in
// storage of fixed size: what a board's program has in static memory. One thread; not real time.
#pragma once

#include <cstddef>
#include <expected>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "firmware/control/controller.h"
#include "firmware/device_file/device_config.h"
#include "firmware/device_file/device_image.h"
#include "hal/bare_metal/stop_code.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

// Why a controller was not started.
struct StartRefusal {
  hal::StopCode code = hal::StopCode::none;
  // The reason in words, which live as long as the images and the LoadedController.
  std::string_view what;
};

// A controller with the views of its images. It is not copied, since the controller refers to it.
class LoadedController {
 public:
  LoadedController() = default;
  LoadedController(const LoadedController&) = delete;
  LoadedController& operator=(const LoadedController&) = delete;
  ~LoadedController() = default;

  // Opens both images, configures the controller and loads the scene. The images begin at a
  // multiple of rendering::kImageAlignment and outlive this. Call it once. Errors: device_image,
  // scene_image, configuration, scene. No other member may be called after an error.
  std::expected<void, StartRefusal> start(std::span<const std::byte> device_image,
                                          std::span<const std::byte> scene_image);

  [[nodiscard]] Controller& controller() { return room_.controller; }
  [[nodiscard]] const DeviceConfig& device() const { return device_; }

 private:
  std::expected<void, StartRefusal> read_device(std::span<const std::byte> image);
  std::expected<const rendering::SceneImage*, StartRefusal> open_scene(
      std::span<const std::byte> image);

  // The sections of a device image take 43 kB while they are read. The controller comes into being
  // after that, in the same memory.
  union Room {
    Room() {}  // NOLINT(modernize-use-equals-default): a defaulted one is deleted
    DeviceSections sections;
    Controller controller;
  };
  // Nothing is destroyed at the end of a program that has none.
  static_assert(std::is_trivially_destructible_v<DeviceSections>);
  static_assert(std::is_trivially_destructible_v<Controller>);

  Room room_;
  DeviceConfig device_;
  std::optional<rendering::SceneImage> scene_;
};

}  // namespace tactus::firmware
