#include "firmware/bare_metal/loaded_controller.h"

#include <memory>
#include <utility>

#include "rendering/scene/scene_world.h"

namespace tactus::firmware {
namespace {

std::unexpected<StartRefusal> refused(hal::StopCode code, std::string_view what) {
  return std::unexpected(StartRefusal{.code = code, .what = what});
}

// Returns the reason in words; a number would need stdio.
std::string_view words_of(SceneFault fault) {
  switch (fault) {
    case SceneFault::active:
      return "the motors are on";
    case SceneFault::world:
      return "the world refuses it";
    case SceneFault::uncertified:
      return "a part is stiffer than certified";
    case SceneFault::costly:
      return "its motions and effects take too much of a tick";
    case SceneFault::capacity:
      return "it exceeds a capacity of the profile";
  }
  return "unknown";
}

}  // namespace

std::expected<void, StartRefusal> LoadedController::read_device(std::span<const std::byte> image) {
  std::construct_at(&room_.sections);
  auto outcome = open_device_image(image, room_.sections);
  if (outcome) {
    outcome = firmware::read_device(room_.sections, device_);
  }
  if (!outcome) {
    return refused(hal::StopCode::device_image, outcome.error().what);
  }
  return {};
}

std::expected<const rendering::SceneImage*, StartRefusal> LoadedController::open_scene(
    std::span<const std::byte> image) {
  auto opened = rendering::SceneImage::open(image);
  if (!opened) {
    return refused(hal::StopCode::scene_image, rendering::describe(opened.error().fault));
  }
  return &scene_.emplace(*std::move(opened));
}

std::expected<void, StartRefusal> LoadedController::start(std::span<const std::byte> device_image,
                                                          std::span<const std::byte> scene_image) {
  if (auto read = read_device(device_image); !read) {
    return read;
  }
  const auto scene = open_scene(scene_image);
  if (!scene) {
    return std::unexpected(scene.error());
  }
  std::construct_at(&room_.controller);
  if (const auto configured = room_.controller.configure(device_.controller); !configured) {
    return refused(hal::StopCode::configuration, configured.error().field);
  }
  const auto loaded =
      room_.controller.load_scene((*scene)->objects(), rendering::world_of(**scene));
  if (!loaded) {
    return refused(hal::StopCode::scene, words_of(loaded.error().fault));
  }
  return {};
}

}  // namespace tactus::firmware
