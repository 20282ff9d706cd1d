// The checked, zero-copy view of a baked scene. A controller opens one and gives its objects and
// effects to World::set_scene (scene_world.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "rendering/effects/effect.h"
#include "rendering/limits.h"
#include "rendering/needle/needle_touch.h"
#include "rendering/objects/object.h"
#include "rendering/objects/object_body.h"
#include "rendering/scene/mesh_check.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

namespace image {
struct Body;
struct Object;
struct Scene;
struct Tissue;
}  // namespace image

// The counts of the repairs that baking made to one mesh.
struct BakeCounters {
  // The vertices that were merged into another at the same place.
  std::uint32_t welded_vertices = 0;
  // The triangles without area, which were dropped.
  std::uint32_t degenerate_triangles = 0;
  // The edges on one triangle only.
  std::uint32_t open_edges = 0;
  // The edges on more than two triangles.
  std::uint32_t non_manifold_edges = 0;
  // The edges that both triangles run along in the same direction.
  std::uint32_t inconsistent_edges = 0;

  bool operator==(const BakeCounters&) const = default;
};

// Views into the bytes given to `open`, which must stay there, unchanged, as long as any view is
// used. Everything is in the world frame, metres. Not for the tick: opening takes time in
// proportion to the image (25 ms for 871,200 triangles on a server's core). No heap, no
// exceptions; any thread.
class SceneImage {
 public:
  // Checks the header, the checksum, the FlatBuffers payload and then every limit of ours; what
  // passes can be used without further checks. Errors: every SceneFault.
  static std::expected<SceneImage, SceneError> open(std::span<const std::byte> bytes);

  // Returns the radius of the tools, m.
  [[nodiscard]] double tool_radius_m() const { return tool_radius_m_; }
  // Returns the number of tools, 1 to kMaxTools.
  [[nodiscard]] std::size_t tool_count() const { return tool_count_; }
  // Return the version and the checksum of the image's header.
  [[nodiscard]] std::uint32_t version() const { return version_; }
  [[nodiscard]] std::uint64_t checksum() const { return checksum_; }

  // Returns the scene's objects: at least one, at most kMaxObjects.
  [[nodiscard]] std::span<const Object> objects() const {
    return std::span(objects_).first(object_count_);
  }

  // Returns the scene's bodies, to which the objects refer: at most kMaxBodies.
  [[nodiscard]] std::span<const ObjectBody> bodies() const {
    return std::span(bodies_).first(body_count_);
  }
  // Returns the convex parts, to which the bodies refer: at most kMaxBodyParts.
  [[nodiscard]] std::span<const BodyPart> body_parts() const {
    return std::span(body_parts_).first(body_part_count_);
  }
  // Returns the gravity that acts on bodies, m/s^2.
  [[nodiscard]] const Vec3& gravity_W() const { return gravity_W_; }
  // Returns the effective modulus of soft fingers, Pa; 0 for fingers that touch in a point.
  [[nodiscard]] double soft_finger_modulus_Pa() const { return soft_finger_modulus_Pa_; }

  // Returns the rest after which bodies fall asleep, s; 0: never.
  [[nodiscard]] double sleep_after_s() const { return sleep_after_s_; }

  // Returns the needle of the tools, and the tissues, to which the objects refer.
  [[nodiscard]] NeedleScene needle() const {
    return {.needle = needle_, .tissues = std::span(tissues_).first(tissue_count_)};
  }

  // Returns the scene's effects: at most kMaxEffects, all valid.
  [[nodiscard]] std::span<const Effect> effects() const {
    return std::span(effects_).first(effect_count_);
  }

  // Return the name, the baked mesh and the counters of an object; `index` counts objects().
  [[nodiscard]] std::string_view object_name(std::size_t index) const;
  [[nodiscard]] BakedMeshView baked_mesh(std::size_t index) const;
  [[nodiscard]] BakeCounters counters(std::size_t index) const;

 private:
  SceneImage() = default;
  // Check a part of the payload and take its views; take() calls the others. A body and a tissue
  // may be nullptr.
  std::expected<void, SceneError> take(const image::Scene& scene);
  std::expected<void, SceneError> take_effects(const image::Scene& scene);
  std::expected<void, SceneError> take_object(const image::Object& object, std::size_t index);
  std::expected<void, SceneError> take_body(const image::Body* stored, Object& object);
  std::expected<void, SceneError> take_body_parts(const image::Body& stored, ObjectBody& body);
  std::expected<void, SceneError> take_tissue(const image::Tissue* stored, Object& object);

  // The payload, in the bytes given to `open`.
  const image::Scene* scene_ = nullptr;
  double tool_radius_m_ = 0.0;
  std::size_t tool_count_ = 1;
  std::uint32_t version_ = 0;
  std::uint64_t checksum_ = 0;
  std::size_t object_count_ = 0;
  std::array<Object, kMaxObjects> objects_{};
  std::size_t effect_count_ = 0;
  std::array<Effect, kMaxEffects> effects_{};
  Vec3 gravity_W_ = standard_gravity_W();
  double soft_finger_modulus_Pa_ = 0.0;
  double sleep_after_s_ = 0.0;
  std::size_t body_count_ = 0;
  std::array<ObjectBody, kMaxBodies> bodies_{};
  std::size_t body_part_count_ = 0;
  std::array<BodyPart, kMaxBodyParts> body_parts_{};
  Needle needle_;
  std::size_t tissue_count_ = 0;
  std::array<Tissue, kMaxTissues> tissues_{};
};

}  // namespace tactus::rendering
