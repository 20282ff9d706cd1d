#include "firmware/linux/commands/scene_store.h"

#include <algorithm>

namespace tactus::firmware {

void SceneStore::Place::clear() {
  image.reset();
  file.clear();
  path.fill('\0');
}

std::expected<const rendering::SceneImage*, SceneStoreError> SceneStore::open_next(
    std::string_view path) {
  Place& place = next();
  place.clear();
  if (path.size() >= place.path.size()) {
    return std::unexpected(SceneStoreError{.what = "the path is too long"});
  }
  std::ranges::copy(path, place.path.begin());
  if (place.file.capacity() == 0) {
    if (const int error = place.file.reserve(room_bytes_); error != 0) {
      place.clear();
      return std::unexpected(SceneStoreError{.what = "no memory for scenes", .errno_value = error});
    }
  }
  if (const hal::FileError error = place.file.read(place.path.data()); error.is_error()) {
    place.clear();
    return std::unexpected(SceneStoreError{.what = error.what, .errno_value = error.errno_value});
  }
  const auto image = rendering::SceneImage::open(place.file.bytes());
  if (!image) {
    place.clear();
    return std::unexpected(SceneStoreError{.what = rendering::describe(image.error(), words_)});
  }
  return &place.image.emplace(*image);
}

void SceneStore::use_next() {
  places_[used_].clear();
  used_ = 1 - used_;
}

void SceneStore::drop_next() {
  next().clear();
}

std::string_view SceneStore::path() const {
  return places_[used_].path.data();
}

std::optional<std::uint32_t> SceneStore::find_object(std::string_view name) const {
  const rendering::SceneImage* const image = scene();
  for (std::uint32_t i = 0; image != nullptr && i < image->objects().size(); ++i) {
    if (image->object_name(i) == name) {
      return i;
    }
  }
  return std::nullopt;
}

}  // namespace tactus::firmware
