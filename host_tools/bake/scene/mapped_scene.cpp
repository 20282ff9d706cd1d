#include "host_tools/bake/scene/mapped_scene.h"

#include <fmt/format.h>

#include <array>
#include <system_error>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

hal::MappedFile map(const fs::path& path) {
  hal::MappedFile file;
  std::error_code error;
  const bool is_file = fs::is_regular_file(path, error);
  if (!is_file && fs::exists(path, error)) {
    throw InputError(fmt::format("{}: is not a file; name a scene image", path.string()));
  }
  if (is_file && fs::file_size(path, error) == 0) {
    return file;  // the image's own check says that it is cut short
  }
  if (const int failure = file.open(path.c_str()); failure != 0) {
    throw InputError(fmt::format("{}: cannot read: {}; check the path and its permissions",
                                 path.string(), std::generic_category().message(failure)));
  }
  return file;
}

rendering::SceneImage open_image(const fs::path& path, std::span<const std::byte> bytes) {
  std::expected<rendering::SceneImage, rendering::SceneError> image =
      rendering::SceneImage::open(bytes);
  if (!image) {
    throw InputError(fmt::format("{}: {}", path.string(), explain(image.error())));
  }
  return *image;
}

}  // namespace

MappedScene::MappedScene(const std::filesystem::path& path)
    : file_(map(path)), image_(open_image(path, file_.bytes())) {}

std::string explain(const rendering::SceneError& error) {
  std::string text;
  if (error.object != rendering::kNoObject) {
    text += fmt::format("object {}: ", error.object);
  }
  if (const std::string_view noun = rendering::place_noun(error.fault); !noun.empty()) {
    text += fmt::format("{} {}: ", noun, error.place);
  }
  if (const std::string_view name = error.name.text(); !name.empty()) {
    text += fmt::format("\"{}\": ", name);
  }
  std::array<char, 256> room{};
  return text + std::string(rendering::describe(error, room));
}

}  // namespace tactus::host
