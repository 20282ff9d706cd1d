#include "host_tools/bake/scene/image_writer.h"

#include <fmt/format.h>

#include <cstring>

#include "host_tools/bake/scene/effect_writer.h"
#include "host_tools/input_error.h"
#include "rendering/limits.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::host {
namespace {

namespace image = rendering::image;
using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

// Bytes for an object's tables, name and padding, in the estimate of the image's size.
constexpr std::uint64_t kObjectOverheadBytes = 4096;

// Writes a vector of structs as bytes, with its first element at a multiple of `alignment` from the
// image's start, minus `shift`.
template <class Stored, class T>
Offset<flatbuffers::Vector<const Stored*>> write_vector(FlatBufferBuilder& builder,
                                                        const std::vector<T>& values,
                                                        std::size_t alignment,
                                                        std::size_t shift = 0) {
  static_assert(sizeof(Stored) == sizeof(T));
  // FlatBuffers builds from the end, so it aligns the distance from the end to the start of the
  // vector.
  builder.ForceVectorAlignment(values.size() * sizeof(T) + shift, 1, alignment);
  const void* bytes = values.data();
  return builder.CreateVectorOfStructs(static_cast<const Stored*>(bytes), values.size());
}

// Writes a vector that the format may lack; an empty one takes no place.
template <class Stored, class T>
Offset<flatbuffers::Vector<const Stored*>> write_optional(FlatBufferBuilder& builder,
                                                          const std::vector<T>& values) {
  return values.empty() ? Offset<flatbuffers::Vector<const Stored*>>{}
                        : write_vector<Stored>(builder, values, rendering::kCacheLine);
}

// Vectors that the controller searches begin at a cache line.
Offset<image::Mesh> write_mesh(FlatBufferBuilder& builder, const BakedMesh& mesh) {
  constexpr std::size_t kLine = rendering::kCacheLine;
  const auto vertices = write_vector<image::Float3>(builder, mesh.vertices, kLine);
  const auto triangles = write_vector<image::Triple>(builder, mesh.triangles, kLine);
  const auto neighbours = write_vector<image::Triple>(builder, mesh.neighbours, kLine);
  const auto normals = write_vector<image::Float3>(builder, mesh.vertex_normals, kLine);
  // The root stands alone in the second half of a cache line. Every pair of siblings, which the
  // search reads together, then shares one cache line.
  const auto nodes =
      write_vector<image::Node>(builder, mesh.nodes, kLine, sizeof(rendering::BvhNode));
  const auto corner_normals = write_optional<image::CornerNormals>(builder, mesh.corner_normals);
  const auto corner_places = write_optional<image::CornerPlaces>(builder, mesh.corner_places);
  const rendering::BakeCounters& c = mesh.counters;
  const image::BakeCounters counters(c.welded_vertices, c.degenerate_triangles, c.open_edges,
                                     c.non_manifold_edges, c.inconsistent_edges);
  return image::CreateMesh(builder, vertices, triangles, neighbours, nodes, normals, &counters,
                           corner_normals, corner_places);
}

Offset<image::Material> write_material(FlatBufferBuilder& builder,
                                       const rendering::Material& material) {
  const rendering::FrictionParameters& model = material.friction;
  const image::Friction friction(std::to_underlying(model.kind), model.coulomb, model.static_level,
                                 model.viscous_s_per_m, model.stribeck_velocity_m_per_s,
                                 model.stribeck_exponent, model.stiffness_N_per_m,
                                 model.damping_s_per_m, model.damping_fade_m_per_s,
                                 model.stick_velocity_m_per_s, model.elastic_fraction);
  const rendering::Float3& way = material.grain.direction_O;
  const image::Grain grain(image::Float3(way.x, way.y, way.z), material.grain.along,
                           material.grain.across);
  return image::CreateMaterial(builder, material.stiffness_N_per_m, material.damping_Ns_per_m,
                               &friction, material.grain.differs() ? &grain : nullptr);
}

image::Pose pose_of(const Placement& placement) {
  return stored(rendering::RigidPose{placement.rotation.toRotationMatrix(), placement.position_m});
}

// Returns the primitive or formula; none for a mesh.
Offset<void> write_shape(FlatBufferBuilder& builder, const BakedObject& object) {
  if (const auto* primitive = std::get_if<rendering::Primitive>(&object.shape)) {
    return write_primitive(builder, *primitive).Union();
  }
  const image::Pose pose = pose_of(object.placement);
  if (const auto* implicit = std::get_if<ImplicitDescription>(&object.shape)) {
    const auto instructions = write_vector<image::Instruction>(
        builder, implicit->formula.instructions, alignof(rendering::Instruction));
    const image::Double3 lower = stored(implicit->bounds_O.lower);
    const image::Double3 upper = stored(implicit->bounds_O.upper);
    return image::CreateImplicit(builder, instructions, &pose, object.placement.scale, &lower,
                                 &upper)
        .Union();
  }
  return {};
}

// Returns the tag of the union `Shape`, in the order of ShapeDescription.
image::Shape shape_type(const ShapeDescription& shape) {
  constexpr std::array kTypes{image::Shape::NONE, image::Shape::Primitive, image::Shape::Implicit};
  return kTypes[shape.index()];
}

std::optional<image::Motion> write_motion(const std::optional<rendering::Motion>& motion) {
  if (!motion) {
    return std::nullopt;
  }
  return image::Motion(stored(motion->velocity_W), stored(motion->sway_W), motion->sway_Hz,
                       stored(motion->spin_W), stored(motion->pivot_W), motion->wave_m,
                       motion->wave_Hz, stored(motion->wave_per_m));
}

// The places of a hull's arrays in the builder.
struct StoredHull {
  Offset<flatbuffers::Vector<const image::Double3*>> vertices;
  Offset<flatbuffers::Vector<const image::HullFace*>> faces;
  Offset<flatbuffers::Vector<std::uint8_t>> corners;
  Offset<flatbuffers::Vector<const image::HullEdge*>> edges;
};

StoredHull write_hull(FlatBufferBuilder& builder, const BakedHull& hull) {
  StoredHull stored_hull;
  stored_hull.vertices = write_optional<image::Double3>(builder, hull.vertices);
  stored_hull.faces = write_optional<image::HullFace>(builder, hull.faces);
  if (!hull.corners.empty()) {
    stored_hull.corners = builder.CreateVector(hull.corners);
  }
  stored_hull.edges = write_optional<image::HullEdge>(builder, hull.edges);
  return stored_hull;
}

// Returns the parts of a body; none for one that has none.
Offset<flatbuffers::Vector<Offset<image::BodyPart>>> write_parts(
    FlatBufferBuilder& builder, const std::vector<BakedPart>& parts) {
  if (parts.empty()) {
    return {};
  }
  std::vector<Offset<image::BodyPart>> stored_parts;
  for (const BakedPart& part : parts) {
    const Offset<image::Primitive> primitive =
        part.primitive ? write_primitive(builder, *part.primitive) : Offset<image::Primitive>{};
    const StoredHull hull = write_hull(builder, part.hull);
    stored_parts.push_back(image::CreateBodyPart(builder, primitive, hull.vertices, hull.faces,
                                                 hull.corners, hull.edges));
  }
  return builder.CreateVector(stored_parts);
}

// Returns the body; none for an object that is none.
Offset<image::Body> write_body(FlatBufferBuilder& builder, const std::optional<BakedBody>& baked) {
  if (!baked) {
    return {};
  }
  const rendering::ObjectBody& body = baked->body;
  const StoredHull hull = write_hull(builder, baked->hull);
  const auto parts = write_parts(builder, baked->parts);
  const Mat3& I = body.mass.inertia_C;
  const image::Inertia inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  const image::Double3 center = stored(body.mass.center_O);
  const image::Pose axes = stored(rendering::RigidPose{body.axes_O, Vec3::Zero()});
  const image::Double3 velocity = stored(body.velocity_W);
  const image::Double3 angular_velocity = stored(body.angular_velocity_O);
  return image::CreateBody(builder, body.mass.mass_kg, &center, &inertia, &axes,
                           body.mass.linear_damping_per_s, body.mass.angular_damping_per_s,
                           body.restitution, &velocity, &angular_velocity, hull.vertices,
                           hull.faces, hull.corners, hull.edges, body.rolling_friction_m,
                           body.spinning_friction_m, parts);
}

std::optional<image::Tissue> write_tissue(const std::optional<rendering::Tissue>& tissue) {
  if (!tissue) {
    return std::nullopt;
  }
  const auto friction = [](const rendering::ShaftFriction& f) {
    return image::ShaftFriction(f.static_N_per_m, f.dynamic_N_per_m, f.viscous_Ns_per_m2);
  };
  return image::Tissue(tissue->stiffness_N_per_m, tissue->stiffness_N_per_m2,
                       tissue->puncture_force_N, tissue->residual_m, tissue->cutting_force_N,
                       tissue->toughness_J_per_m2, friction(tissue->in), friction(tissue->out),
                       tissue->shaft_stiffness_N_per_m2, tissue->lateral_stiffness_N_per_m2,
                       tissue->relaxation_s);
}

Offset<image::Object> write_object(FlatBufferBuilder& builder, const BakedObject& object) {
  const auto mesh = write_mesh(builder, object.mesh);
  const auto material = write_material(builder, object.material);
  const auto name = builder.CreateString(object.name);
  const auto sides = object.sides == rendering::Sides::one ? image::Sides::one : image::Sides::two;
  const auto shape = write_shape(builder, object);
  const std::optional<image::Motion> motion = write_motion(object.motion.motion);
  const auto body = write_body(builder, object.body);
  const std::optional<image::Tissue> tissue = write_tissue(object.tissue);
  const auto layers = write_optional<image::TextureLayer>(builder, object.textures.layers);
  const auto texels = object.textures.texels.empty() ? Offset<flatbuffers::Vector<std::uint8_t>>{}
                                                     : builder.CreateVector(object.textures.texels);
  return image::CreateObject(
      builder, name, sides, material, mesh, static_cast<std::uint8_t>(object.contact),
      shape_type(object.shape), shape, object.motion.moves, layers, texels, object.motion.deforms,
      motion ? &*motion : nullptr, object.push_out_m, body, tissue ? &*tissue : nullptr);
}

// Returns an upper bound of the image's size, so that the builder reserves memory once.
std::uint64_t estimated_bytes(const BakedScene& scene) {
  std::uint64_t bytes = kObjectOverheadBytes;
  for (const BakedObject& object : scene.objects) {
    bytes += image_bytes(object.mesh) + object.textures.texels.size() + object.name.size() +
             kObjectOverheadBytes;
  }
  return bytes;
}

// Puts the header with size and checksum before the content.
std::vector<std::byte> with_header(std::span<const std::uint8_t> payload) {
  rendering::ImageHeader header;
  header.payload_bytes = payload.size();
  header.checksum = rendering::image_checksum(header, std::as_bytes(payload));
  std::vector<std::byte> bytes(sizeof(header) + payload.size());
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::memcpy(bytes.data() + sizeof(header), payload.data(), payload.size());
  return bytes;
}

}  // namespace

std::uint64_t image_bytes(const BakedMesh& mesh) {
  return std::as_bytes(std::span(mesh.vertices)).size() +
         std::as_bytes(std::span(mesh.triangles)).size() +
         std::as_bytes(std::span(mesh.neighbours)).size() +
         std::as_bytes(std::span(mesh.vertex_normals)).size() +
         std::as_bytes(std::span(mesh.nodes)).size() +
         std::as_bytes(std::span(mesh.corner_normals)).size() +
         std::as_bytes(std::span(mesh.corner_places)).size();
}

std::vector<std::byte> write_image(const BakedScene& scene) {
  if (scene.objects.empty() || scene.objects.size() > rendering::kMaxObjects) {
    throw InputError(fmt::format("{} objects, where 1 to {} fit; split the scene",
                                 scene.objects.size(), rendering::kMaxObjects));
  }
  const std::uint64_t estimate = estimated_bytes(scene);
  if (estimate > rendering::kMaxPayloadBytes) {
    throw InputError(fmt::format("the image would take {} MB, where 2147 fit; simplify the meshes",
                                 estimate / 1'000'000));
  }
  FlatBufferBuilder builder(static_cast<std::size_t>(estimate));
  std::vector<Offset<image::Object>> objects;
  objects.reserve(scene.objects.size());
  for (const BakedObject& object : scene.objects) {
    objects.push_back(write_object(builder, object));
  }
  const auto effects = write_effects(builder, scene.effects);
  const std::optional<image::Double3> gravity =
      scene.gravity_W ? std::optional(stored(*scene.gravity_W)) : std::nullopt;
  std::optional<image::Needle> needle;
  if (scene.needle) {
    needle = image::Needle(stored(scene.needle->axis_W), scene.needle->length_m,
                           scene.needle->width_m, scene.needle->tip_stiffness_N_per_m);
  }
  const auto root = image::CreateScene(builder, scene.tool_radius_m, builder.CreateVector(objects),
                                       static_cast<std::uint8_t>(scene.tool_count), effects,
                                       gravity ? &*gravity : nullptr, needle ? &*needle : nullptr,
                                       scene.soft_finger_modulus_Pa, scene.sleep_after_s);
  image::FinishSceneBuffer(builder, root);
  return with_header({builder.GetBufferPointer(), builder.GetSize()});
}

}  // namespace tactus::host
