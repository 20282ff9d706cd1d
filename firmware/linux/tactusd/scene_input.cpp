#include "firmware/linux/tactusd/scene_input.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "firmware/device_file/certificate_words.h"
#include "firmware/linux/tactusd/messages.h"
#include "rendering/scene/scene_world.h"

namespace tactus::firmware {
namespace {

// Prints why the controller has refused the scene.
void tell_refusal(const Options& options, const rendering::SceneImage& scene,
                  const SceneRefusal& refusal) {
  std::array<char, kMaxMessage> room{};
  const std::string_view words = refusal_words(refusal, names_of(refusal.part, scene), room);
  const bool is_of_a_device = refusal.fault == SceneFault::uncertified && options.device_count > 1;
  std::fprintf(stderr, "tactusd: %s: %s%s%.*s\n", options.scene,
               is_of_a_device ? options.devices[refusal.device] : "", is_of_a_device ? ": " : "",
               length(words), words.data());
}

}  // namespace

bool load_scene(const Options& options, SceneStore& scenes, Controller& controller) {
  scenes.set_room(options.scene_memory_bytes);
  if (options.scene == nullptr) {
    return true;
  }
  const auto opened = scenes.open_next(options.scene);
  if (!opened) {
    const SceneStoreError& error = opened.error();
    std::fprintf(stderr, "tactusd: %s: %.*s%s%s\n", options.scene, length(error.what),
                 error.what.data(), error.errno_value != 0 ? ": " : "",
                 error.errno_value != 0 ? std::strerror(error.errno_value) : "");
    return false;
  }
  const rendering::SceneImage& scene = **opened;
  const auto loaded = controller.load_scene(scene.objects(), rendering::world_of(scene));
  if (!loaded) {
    tell_refusal(options, scene, loaded.error());
    return false;
  }
  scenes.use_next();
  return true;
}

}  // namespace tactus::firmware
