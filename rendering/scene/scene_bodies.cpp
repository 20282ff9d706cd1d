// Takes what the objects of an image refer to: bodies with their parts, and tissues. There is room
// for them: take() has checked stored_counts() before.
#include "rendering/scene/body_reader.h"
#include "rendering/scene/needle_reader.h"
#include "rendering/scene/scene_generated.h"
#include "rendering/scene/scene_image.h"

namespace tactus::rendering {

std::expected<void, SceneError> SceneImage::take_body(const image::Body* stored, Object& object) {
  if (stored == nullptr) {
    return {};
  }
  std::expected<ObjectBody, SceneError> body = read_body(*stored, object);
  if (!body) {
    return std::unexpected(body.error());
  }
  if (const auto parts = take_body_parts(*stored, *body); !parts) {
    return parts;
  }
  object.body = static_cast<std::uint8_t>(body_count_);
  bodies_[body_count_++] = *body;
  return {};
}

std::expected<void, SceneError> SceneImage::take_body_parts(const image::Body& stored,
                                                            ObjectBody& body) {
  body.first_part = static_cast<std::uint32_t>(body_part_count_);
  for (std::uint32_t i = 0; i < body.part_count; ++i) {
    const std::expected<BodyPart, SceneError> part = read_body_part(*stored.parts()->Get(i));
    if (!part) {
      SceneError error = part.error();
      error.place = i;
      return std::unexpected(error);
    }
    body_parts_[body_part_count_++] = *part;
  }
  return {};
}

std::expected<void, SceneError> SceneImage::take_tissue(const image::Tissue* stored,
                                                        Object& object) {
  if (stored == nullptr) {
    return {};
  }
  const std::expected<Tissue, SceneError> tissue = read_tissue(*stored, needle_, object);
  if (!tissue) {
    return std::unexpected(tissue.error());
  }
  object.tissue = static_cast<std::uint8_t>(tissue_count_);
  tissues_[tissue_count_++] = *tissue;
  return {};
}

}  // namespace tactus::rendering
