#include "host_tools/foxglove/served_scene.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"

namespace tactus::host {
namespace {

// Returns the file of the scene in a reply to `status`; empty if there is none.
std::string scene_file_in(const std::string& reply) {
  const std::string file = field_of(reply, "scene").value_or("");
  return file == "none" ? std::string{} : file;
}

}  // namespace

std::string ServedScene::find(const std::filesystem::path& folder) {
  scene_.reset();
  try {
    const std::string file = scene_file_in(Remote(folder).send("status").text);
    if (file.empty()) {
      return "the controller has no scene";
    }
    scene_ = std::make_unique<MappedScene>(file);
    return {};
  } catch (const UnreachableError& error) {
    return fmt::format("the scene is not shown: {}", error.what());
  } catch (const InputError& error) {
    return fmt::format("the scene is not shown: {}", error.what());
  }
}

}  // namespace tactus::host
