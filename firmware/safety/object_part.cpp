#include "firmware/safety/object_part.h"

#include <algorithm>

#include "rendering/limits.h"

namespace tactus::firmware {
namespace {

// The smallest and the largest stiffness that an object's textures make.
struct StiffnessRange {
  double least_N_per_m = 0.0;
  double most_N_per_m = 0.0;
};

// Returns the range over the object's surface.
StiffnessRange stiffness_of(const rendering::Object& object, const rendering::Material& material) {
  double low = 1.0;
  double high = 1.0;
  for (const rendering::TextureLayer& layer : object.detail.layers) {
    if (layer.use == rendering::TextureUse::stiffness) {
      low = std::min(layer.low, layer.high);
      high = std::max(layer.low, layer.high);
    }
  }
  return {.least_N_per_m = low * material.stiffness_N_per_m,
          .most_N_per_m = high * material.stiffness_N_per_m};
}

bool along_world_axis(const Vec3& direction_W) {
  return direction_W.cwiseAbs().maxCoeff() > 1.0 - kSameDirection;
}

// Returns the box of a plane, which ends at the plane if the plane is along an axis of the world.
rendering::Bounds half_space(const rendering::Primitive& plane) {
  rendering::Bounds box = FeltRegion{}.box;
  const Vec3 normal_W = plane.X_WO.rotation.col(1);
  if (along_world_axis(normal_W)) {
    Eigen::Index axis = 0;
    normal_W.cwiseAbs().maxCoeff(&axis);
    (normal_W[axis] > 0.0 ? box.upper_W : box.lower_W)[axis] = plane.X_WO.translation[axis];
  }
  return box;
}

bool is_plane(const rendering::Object& object) {
  return object.surface == rendering::SurfaceKind::primitive &&
         object.primitive.kind == rendering::PrimitiveKind::plane;
}

bool is_box_field(const rendering::Object& object) {
  return object.surface == rendering::SurfaceKind::primitive &&
         object.primitive.kind == rendering::PrimitiveKind::box &&
         object.method == rendering::ContactMethod::potential_field;
}

bool is_box_along_axes(const rendering::Object& object) {
  const Mat3& rotation = object.primitive.X_WO.rotation;
  return object.surface == rendering::SurfaceKind::primitive &&
         object.primitive.kind == rendering::PrimitiveKind::box &&
         along_world_axis(rotation.col(0)) && along_world_axis(rotation.col(1));
}

// Returns true if the stretch of the proxy is along the normal only. A potential field has no
// friction.
bool is_smooth(const rendering::Object& object, const rendering::Material& material) {
  if (object.method == rendering::ContactMethod::potential_field) {
    return true;
  }
  return !has_friction(material.friction) && object.detail.empty();
}

bool has_bounds(const rendering::Object& object) {
  return object.surface != rendering::SurfaceKind::mesh || !object.mesh.nodes.empty();
}

// Returns true if the tool's sphere touches the object, and not only its centre.
bool is_sphere_to(const rendering::Object& object) {
  return object.method == rendering::ContactMethod::sphere_proxy ||
         object.method == rendering::ContactMethod::potential_field;
}

// Returns the largest distance beyond its surface at which the tool feels the object more the
// deeper it goes, m. A potential field keeps no proxy, so this is only the tool's radius there.
double felt_beyond_m(const rendering::Object& object, double stiffness_N_per_m,
                     const SceneFeel& feel) {
  if (object.method == rendering::ContactMethod::potential_field) {
    return 0.0;
  }
  return stiffness_N_per_m > 0.0 ? std::min(feel.max_force_N / stiffness_N_per_m, kBoundless_m)
                                 : kBoundless_m;
}

// Returns the box in which the tool's centre feels the object. The tool is in contact with a smooth
// box along the axes only if it came in through a side, so it leaves the other side with less depth
// left.
rendering::Bounds felt_box(const rendering::Object& object, const rendering::Material& material,
                           const ScenePart& part, double beyond_m) {
  Vec3 beyond = Vec3::Constant(beyond_m);
  if (is_box_along_axes(object) && is_smooth(object, material)) {
    beyond = (beyond - (part.surface.upper_W - part.surface.lower_W)).cwiseMax(0.0);
  }
  const rendering::Bounds contact = grown(part.surface, part.contact_m + kSamePlace_m);
  return {.lower_W = contact.lower_W - beyond, .upper_W = contact.upper_W + beyond};
}

// Returns the part of an object that only the needle meets. There is one needle, wherever it is, so
// the first tissue stands for all.
ScenePart part_of_tissue(const rendering::Object& object, const SceneFeel& feel) {
  const rendering::NeedleImpedance most = largest_impedance(feel.needle);
  const bool is_first = object.tissue == 0;
  return {.felt = {.damping_Ns_per_m = is_first ? most.damping_Ns_per_m : 0.0,
                   .stiffness_N_per_m = is_first ? most.stiffness_N_per_m : 0.0},
          .surface = FeltRegion{}.box};
}

}  // namespace

ScenePart part_of_object(const rendering::Object& object, const rendering::Material& material,
                         const SceneFeel& feel) {
  if (is_tissue(object)) {
    return part_of_tissue(object, feel);
  }
  const StiffnessRange stiffness = stiffness_of(object, material);
  ScenePart part{.felt = {.damping_Ns_per_m = material.damping_Ns_per_m,
                          .stiffness_N_per_m = stiffness.most_N_per_m},
                 .shares_proxy = rendering::meets_proxy(object),
                 .surface = FeltRegion{}.box};
  if (rendering::is_mover(object) || !has_bounds(object)) {
    return part;  // the object may move anywhere
  }
  part.contact_m = is_sphere_to(object) ? feel.tool_radius_m : 0.0;
  if (is_plane(object)) {
    const double below_m = rendering::meets_proxy(object)
                               ? felt_beyond_m(object, stiffness.least_N_per_m, feel)
                               : kBoundless_m;
    part.axis_W = object.primitive.X_WO.rotation.col(1);
    part.region = slab(object.primitive.X_WO.translation, part.axis_W, below_m,
                       part.contact_m + kSamePlace_m);
    part.surface = half_space(object.primitive);
    part.directions =
        is_smooth(object, material) ? SpringDirections::along_axis : SpringDirections::all;
  } else {
    part.surface = rendering::bounds_of(object);
    part.region.box =
        felt_box(object, material, part, felt_beyond_m(object, stiffness.least_N_per_m, feel));
  }
  if (is_box_field(object)) {
    part.field_box = &object.primitive;
  }
  part.has_flat_sides = is_plane(object) || is_box_along_axes(object);
  return part;
}

}  // namespace tactus::firmware
