#include "host_tools/foxglove/served_scene.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"

namespace tactus::host {
namespace {

// Returns the file of the scene in a reply to `status`; empty if there is none. It is the last
// field, because a path may have blanks.
std::string scene_file_in(const std::string& reply) {
  constexpr std::string_view kKey = " scene=";
  constexpr std::string_view kNone = "none";
  const std::size_t at = reply.find(kKey);
  if (at == std::string::npos) {
    return {};
  }
  std::string file = reply.substr(at + kKey.size());
  return file == kNone ? std::string{} : file;
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
