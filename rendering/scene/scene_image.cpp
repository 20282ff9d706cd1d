#include "rendering/scene/scene_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::rendering {
namespace {

using Result = std::expected<void, SceneError>;

std::unexpected<SceneError> fail(SceneFault fault, std::uint64_t place = 0) {
  return std::unexpected(SceneError{.fault = fault, .place = place});
}

// A FlatBuffers vector of structs as the house's own type of the same bytes.
template <class T, class Stored>
std::span<const T> in_place(const flatbuffers::Vector<const Stored*>* stored) {
  static_assert(sizeof(T) == sizeof(Stored) && alignof(T) == alignof(Stored));
  const void* data = stored->Data();
  return {static_cast<const T*>(data), stored->size()};
}

static_assert(offsetof(BvhNode, first) == 12 && offsetof(BvhNode, upper) == 16 &&
              offsetof(BvhNode, triangle_count) == 28);
static_assert(std::to_underlying(image::Sides::one) == std::to_underlying(Sides::one) &&
              std::to_underlying(image::Sides::two) == std::to_underlying(Sides::two));

BakedMeshView view(const image::Mesh& mesh) {
  return {.mesh = {.vertices = in_place<Float3>(mesh.vertices()),
                   .triangles = in_place<TriangleIndices>(mesh.triangles()),
                   .nodes = in_place<BvhNode>(mesh.nodes())},
          .neighbours = in_place<TriangleNeighbours>(mesh.neighbours()),
          .vertex_normals = in_place<Float3>(mesh.vertex_normals())};
}

static_assert(sizeof(Instruction) == sizeof(image::Instruction) && offsetof(Instruction, a) == 2 &&
              offsetof(Instruction, exponent) == 6 && offsetof(Instruction, constant) == 8);

Vec3 to_vec3(const image::Double3& v) {
  return {v.x(), v.y(), v.z()};
}

RigidPose to_pose(const image::Pose& stored) {
  RigidPose pose;
  pose.rotation << to_vec3(stored.x_axis()), to_vec3(stored.y_axis()), to_vec3(stored.z_axis());
  pose.translation = to_vec3(stored.origin());
  return pose;
}

// A rotation to 1e-9, within the world.
bool is_pose(const RigidPose& pose) {
  constexpr double kTolerance = 1e-9;
  const Mat3 product = pose.rotation * pose.rotation.transpose();
  return (product - Mat3::Identity()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kTolerance &&
         pose.rotation.determinant() > 0.0 &&
         pose.translation.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
}

Result take_primitive(const image::Primitive& stored, Object& object) {
  object.surface = SurfaceKind::primitive;
  object.primitive = {.kind = static_cast<PrimitiveKind>(stored.kind()),
                      .X_WO = to_pose(*stored.pose()),
                      .dimensions_m = {stored.dimensions()->x(), stored.dimensions()->y(),
                                       stored.dimensions()->z()}};
  if (stored.kind() > std::to_underlying(PrimitiveKind::torus) || !valid(object.primitive)) {
    return fail(SceneFault::shape);
  }
  return {};
}

Result take_implicit(const image::Implicit& stored, Object& object) {
  object.surface = SurfaceKind::implicit;
  ImplicitSurface& implicit = object.implicit;
  const RigidPose pose = to_pose(*stored.pose());
  implicit = {.formula = {in_place<Instruction>(stored.instructions())},
              .bounds_O = {.lower = to_vec3(*stored.lower()), .upper = to_vec3(*stored.upper())},
              .R_WO = pose.rotation,
              .p_WO = pose.translation,
              .scale_m = stored.scale(),
              .sides = object.sides};
  const Vec3 size = implicit.bounds_O.upper - implicit.bounds_O.lower;
  const bool in_range = is_pose(pose) && implicit.scale_m > 0.0 &&
                        implicit.scale_m <= kWorldBound_m && implicit.bounds_O.lower.allFinite() &&
                        size.allFinite() && size.minCoeff() > 0.0;
  if (!in_range) {
    return fail(SceneFault::shape);
  }
  if (const auto checked = check(implicit.formula); !checked) {
    return fail(SceneFault::formula, checked.error().place);
  }
  return {};
}

Result take_shape(const image::Object& stored, Object& object) {
  if (const image::Primitive* primitive = stored.shape_as_Primitive()) {
    return take_primitive(*primitive, object);
  }
  if (const image::Implicit* implicit = stored.shape_as_Implicit()) {
    return take_implicit(*implicit, object);
  }
  return stored.shape_type() == image::Shape::NONE ? Result{} : Result{fail(SceneFault::shape)};
}

bool is_coefficient(double value) {
  return std::isfinite(value) && value >= 0.0;
}

std::expected<Material, SceneError> read_material(const image::Material& stored) {
  Material material{.stiffness_N_per_m = stored.stiffness(),
                    .damping_Ns_per_m = stored.damping(),
                    .friction = {}};
  if (const image::ConeFriction* cone = stored.friction_as_ConeFriction()) {
    material.friction = {.static_coefficient = cone->static_coefficient(),
                         .dynamic_coefficient = cone->dynamic_coefficient()};
  } else if (stored.friction_type() != image::Friction::NONE) {
    return fail(SceneFault::friction_model, std::to_underlying(stored.friction_type()));
  }
  const ConeFriction& friction = material.friction;
  if (!is_coefficient(material.stiffness_N_per_m) || !is_coefficient(material.damping_Ns_per_m) ||
      !is_coefficient(friction.static_coefficient) ||
      !is_coefficient(friction.dynamic_coefficient) ||
      friction.dynamic_coefficient > friction.static_coefficient) {
    return fail(SceneFault::material);
  }
  return material;
}

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

// The header if it is sound and `bytes` are as many as it states.
std::expected<ImageHeader, SceneError> read_header(std::span<const std::byte> bytes) {
  ImageHeader header;
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % kImageAlignment != 0) {
    return fail(SceneFault::misaligned);
  }
  // What a short file has not keeps its default, so that one is called cut short if it begins
  // like an image, and of another kind otherwise.
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

Result SceneImage::take(const image::Scene& scene) {
  scene_ = &scene;
  tool_radius_m_ = scene.tool_radius();
  if (!is_coefficient(tool_radius_m_)) {
    return fail(SceneFault::tool_radius);
  }
  object_count_ = scene.objects()->size();
  if (object_count_ == 0 || object_count_ > kMaxObjects) {
    return fail(SceneFault::object_count, object_count_);
  }
  for (std::uint32_t i = 0; i < object_count_; ++i) {
    if (Result taken = take_object(*scene.objects()->Get(i), i); !taken) {
      taken.error().object = i;
      return taken;
    }
  }
  return {};
}

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
  if (const Result shape = take_shape(object, taken); !shape) {
    return shape;
  }
  if (object.method() > std::to_underlying(ContactMethod::tracking) || !usable(taken)) {
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
  const image::BakeCounters& stored =
      *scene_->objects()->Get(static_cast<flatbuffers::uoffset_t>(index))->mesh()->counters();
  return {.welded_vertices = stored.welded_vertices(),
          .degenerate_triangles = stored.degenerate_triangles(),
          .open_edges = stored.open_edges(),
          .non_manifold_edges = stored.non_manifold_edges(),
          .inconsistent_edges = stored.inconsistent_edges()};
}

}  // namespace tactus::rendering
