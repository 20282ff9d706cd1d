#include "rendering/scene/scene_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rendering/scene/body_reader.h"
#include "rendering/scene/effect_reader.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/needle_reader.h"
#include "rendering/scene/scene_generated.h"
#include "rendering/scene/scene_world.h"
#include "rendering/scene/shape_reader.h"
#include "rendering/scene/stored.h"
#include "rendering/scene/stored_counts.h"

namespace tactus::rendering {
namespace {

using Result = std::expected<void, SceneError>;

// The types of the image are used in place, so their layouts must be those of the schema.
// in_place() compares the sizes; these are the offsets that padding could move.
static_assert(offsetof(BvhNode, first) == 12 && offsetof(BvhNode, upper) == 16 &&
              offsetof(BvhNode, triangle_count) == 28);
static_assert(offsetof(TextureLayer, width) == 4 && offsetof(TextureLayer, first_byte) == 12 &&
              offsetof(TextureLayer, high) == 32);
static_assert(std::to_underlying(image::Sides::one) == std::to_underlying(Sides::one) &&
              std::to_underlying(image::Sides::two) == std::to_underlying(Sides::two));

// Returns the views of a stored mesh.
BakedMeshView view(const image::Mesh& mesh) {
  return {.mesh = {.vertices = in_place<Float3>(mesh.vertices()),
                   .triangles = in_place<TriangleIndices>(mesh.triangles()),
                   .nodes = in_place<BvhNode>(mesh.nodes())},
          .neighbours = in_place<TriangleNeighbours>(mesh.neighbours()),
          .vertex_normals = in_place<Float3>(mesh.vertex_normals())};
}

// Returns the views of an object's stored detail.
SurfaceDetail view_detail(const image::Object& stored) {
  const flatbuffers::Vector<std::uint8_t>* texels = stored.texels();
  return {.corner_normals = in_place<CornerNormals>(stored.mesh()->corner_normals()),
          .corner_places = in_place<CornerPlaces>(stored.mesh()->corner_places()),
          .layers = in_place<TextureLayer>(stored.textures()),
          .texels = texels == nullptr ? std::span<const std::uint8_t>{}
                                      : std::span(texels->data(), texels->size())};
}

// Rejects detail on a shape: its mesh is only a picture.
Result check_detail(const Object& object) {
  const bool is_mesh = object.surface == SurfaceKind::mesh;
  const DetailCheck checked = check(object.detail, is_mesh ? object.mesh.triangles.size() : 0);
  switch (checked.fault) {
    case DetailFault::normals:
      return fail(SceneFault::corner_normals, checked.place);
    case DetailFault::places:
      return fail(SceneFault::corner_places, checked.place);
    case DetailFault::layer:
      return fail(SceneFault::texture, checked.place);
    default:
      return {};
  }
}

// Returns the stored friction parameters, unchecked; sound() checks them with the material.
FrictionParameters friction_of(const image::Friction& stored) {
  return {.kind = static_cast<FrictionKind>(stored.kind()),
          .coulomb = stored.coulomb(),
          .static_level = stored.static_level(),
          .viscous_s_per_m = stored.viscous(),
          .stribeck_velocity_m_per_s = stored.stribeck_velocity(),
          .stribeck_exponent = stored.stribeck_exponent(),
          .stiffness_N_per_m = stored.stiffness(),
          .damping_s_per_m = stored.damping(),
          .damping_fade_m_per_s = stored.damping_fade(),
          .stick_velocity_m_per_s = stored.stick_velocity(),
          .elastic_fraction = stored.elastic_fraction()};
}

// Returns the stored material, or the fault that it has.
std::expected<Material, SceneError> read_material(const image::Material& stored) {
  const image::Friction& friction = *stored.friction();
  if (friction.kind() >= kFrictionKinds) {
    return fail(SceneFault::friction_model, friction.kind());
  }
  Material material{.stiffness_N_per_m = stored.stiffness(),
                    .damping_Ns_per_m = stored.damping(),
                    .friction = friction_of(friction),
                    .grain = {}};
  if (const image::Grain* grain = stored.grain()) {
    material.grain = {
        .direction_O = {grain->direction().x(), grain->direction().y(), grain->direction().z()},
        .along = grain->along(),
        .across = grain->across()};
  }
  if (!sound(material)) {
    return fail(SceneFault::material);
  }
  return material;
}

// Returns the first of the two that does not match.
Result check_magic_and_version(const ImageHeader& header) {
  const auto [found, expected] = std::ranges::mismatch(header.magic, kImageMagic);
  if (found != header.magic.end()) {
    return fail(SceneFault::wrong_magic, static_cast<std::uint64_t>(found - header.magic.begin()));
  }
  if (header.version != kFormatVersion) {
    return fail(
        header.version > kFormatVersion ? SceneFault::newer_version : SceneFault::older_version,
        header.version);
  }
  return {};
}

// Returns the header if it is sound and `bytes` are as many as it states.
std::expected<ImageHeader, SceneError> read_header(std::span<const std::byte> bytes) {
  ImageHeader header;
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % kImageAlignment != 0) {
    return fail(SceneFault::misaligned);
  }
  // A short file leaves the rest of the header at its default: it counts as cut short if it begins
  // like an image, and as another kind otherwise.
  std::ranges::copy(bytes.first(std::min(bytes.size(), sizeof(header))),
                    std::as_writable_bytes(std::span(&header, 1)).begin());
  if (const Result identity = check_magic_and_version(header); !identity) {
    return std::unexpected(identity.error());
  }
  if (bytes.size() < sizeof(header)) {
    return fail(SceneFault::truncated, bytes.size());
  }
  if (header.payload_bytes > kMaxPayloadBytes) {
    return fail(SceneFault::too_large, header.payload_bytes);
  }
  const std::uint64_t whole = sizeof(header) + header.payload_bytes;
  if (bytes.size() < whole) {
    return fail(SceneFault::truncated, bytes.size());
  }
  if (bytes.size() > whole) {
    return fail(SceneFault::trailing_bytes, whole);
  }
  return header;
}

}  // namespace

std::expected<SceneImage, SceneError> SceneImage::open(std::span<const std::byte> bytes) {
  const std::expected<ImageHeader, SceneError> header = read_header(bytes);
  if (!header) {
    return std::unexpected(header.error());
  }
  const std::span<const std::byte> payload = bytes.subspan(sizeof(ImageHeader));
  if (image_checksum(*header, payload) != header->checksum) {
    return fail(SceneFault::checksum_mismatch);
  }
  const void* data = payload.data();
  flatbuffers::Verifier verifier(static_cast<const std::uint8_t*>(data), payload.size());
  if (!image::VerifySceneBuffer(verifier)) {
    return fail(SceneFault::malformed);
  }
  SceneImage result;
  result.version_ = header->version;
  result.checksum_ = header->checksum;
  if (const Result taken = result.take(*image::GetScene(data)); !taken) {
    return std::unexpected(taken.error());
  }
  return result;
}

// Takes the scene: radius and number of tools, effects, objects. Before that it checks the
// capacities that have an array here, and afterwards all of them.
Result SceneImage::take(const image::Scene& scene) {
  scene_ = &scene;
  if (const auto exceeded = first_exceeded(stored_counts(scene), kProfile)) {
    return fail(*exceeded);
  }
  tool_radius_m_ = scene.tool_radius();
  if (!is_tool_radius(tool_radius_m_)) {
    return fail(SceneFault::tool_radius);
  }
  tool_count_ = scene.tool_count();
  if (tool_count_ == 0) {
    return fail(SceneFault::tool_count);
  }
  if (const Result effects = take_effects(scene); !effects) {
    return effects;
  }
  gravity_W_ = read_gravity(scene.gravity());
  soft_finger_modulus_Pa_ = read_finger_modulus(scene.soft_finger_modulus());
  sleep_after_s_ = read_sleep_time(scene.sleep_after());
  const std::expected<Needle, SceneError> needle = read_needle(scene.needle());
  if (!needle) {
    return std::unexpected(needle.error());
  }
  needle_ = *needle;
  object_count_ = scene.objects()->size();
  if (object_count_ == 0) {
    return fail(SceneFault::object_count);
  }
  for (std::uint32_t i = 0; i < object_count_; ++i) {
    if (Result taken = take_object(*scene.objects()->Get(i), i); !taken) {
      taken.error().object = i;
      return taken;
    }
  }
  if (const auto exceeded = first_exceeded(scene_counts(*this), kProfile)) {
    return fail(*exceeded);
  }
  return {};
}

Result SceneImage::take_effects(const image::Scene& scene) {
  effect_count_ = scene.effects() == nullptr ? 0 : scene.effects()->size();
  for (std::uint32_t i = 0; i < effect_count_; ++i) {
    const std::expected<Effect, SceneError> effect = read_effect(*scene.effects()->Get(i));
    if (!effect) {
      SceneError error = effect.error();
      error.place = i;
      return std::unexpected(error);
    }
    effects_[i] = *effect;
  }
  return {};
}

// Takes one object. The mesh is checked first, since everything else may refer to it; usable() has
// the last word on whether the method goes with the surface.
Result SceneImage::take_object(const image::Object& object, std::size_t index) {
  if (object.sides() > image::Sides::MAX) {
    return fail(SceneFault::sides, std::to_underlying(object.sides()));
  }
  const std::expected<Material, SceneError> material = read_material(*object.material());
  if (!material) {
    return std::unexpected(material.error());
  }
  const BakedMeshView baked = view(*object.mesh());
  if (const Result mesh = check_mesh(baked); !mesh) {
    return mesh;
  }
  Object& taken = objects_[index];
  taken.mesh = baked.mesh;
  taken.neighbours = baked.neighbours;
  taken.vertex_normals = baked.vertex_normals;
  taken.sides = static_cast<Sides>(object.sides());
  taken.material = *material;
  taken.method = static_cast<ContactMethod>(object.method());
  taken.push_out_m = object.push_out();
  if (const Result shape = take_shape(object, taken); !shape) {
    return shape;
  }
  taken.moves = object.moves();
  taken.deforms = object.deforms();
  taken.motion = in_place<Motion>(object.motion());
  if (taken.motion != nullptr && (!valid(*taken.motion) || !is_mover(taken))) {
    return fail(SceneFault::motion, 0);
  }
  if (const Result body = take_body(object.body(), taken); !body) {
    return body;
  }
  if (const Result tissue = take_tissue(object.tissue(), taken); !tissue) {
    return tissue;
  }
  if (!is_aligned(object.textures())) {
    return fail(SceneFault::malformed);
  }
  taken.detail = view_detail(object);
  if (const Result detail = check_detail(taken); !detail) {
    return detail;
  }
  if (object.method() > std::to_underlying(kLastContactMethod) || !usable(taken)) {
    return fail(SceneFault::method, object.method());
  }
  return {};
}

std::string_view SceneImage::object_name(std::size_t index) const {
  const flatbuffers::String* name =
      scene_->objects()->Get(static_cast<flatbuffers::uoffset_t>(index))->name();
  return {name->c_str(), name->size()};
}

BakedMeshView SceneImage::baked_mesh(std::size_t index) const {
  return view(*scene_->objects()->Get(static_cast<flatbuffers::uoffset_t>(index))->mesh());
}

BakeCounters SceneImage::counters(std::size_t index) const {
  return *in_place<BakeCounters>(
      scene_->objects()->Get(static_cast<flatbuffers::uoffset_t>(index))->mesh()->counters());
}

}  // namespace tactus::rendering
