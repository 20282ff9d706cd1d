#include "host_tools/bake/scene/body_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "host_tools/bake/body/inertia.h"
#include "host_tools/bake/body/mass_properties.h"
#include "host_tools/bake/body/primitive_mass.h"
#include "host_tools/input_error.h"
#include "host_tools/units.h"
#include "rendering/bodies/primitive_hull.h"

namespace tactus::host {
namespace {

// Returns the properties in the frame that a pose leads to.
MassProperties moved_by(const MassProperties& properties, const rendering::RigidPose& pose) {
  return {.mass_kg = properties.mass_kg,
          .center_O = pose.point(properties.center_O),
          .inertia_C = pose.rotation * properties.inertia_C * pose.rotation.transpose()};
}

// Returns the mass properties of the mesh. For a body of parts the error names the keys that stand
// in for a closed mesh.
MassProperties mass_of_mesh(const BodyDescription& description, const BakedMesh& mesh) {
  try {
    return mesh_mass_properties(std::span<const rendering::Float3>(mesh.vertices), mesh.triangles,
                                description.density_kg_per_m3);
  } catch (const InputError& error) {
    if (description.parts.empty()) {
      throw;
    }
    throw InputError(fmt::format(
        "{}; parts may overlap and say nothing about the mass: close the mesh, or write mass_kg, "
        "center_of_mass_m and inertia_kg_m2",
        error.what()));
  }
}

// Returns the mass properties of the shape, in the frame of the scene, as far as the description
// does not say them.
MassProperties mass_of(const BodyDescription& description, const ShapeDescription& shape,
                       const BakedMesh& mesh, const Placement& placement) {
  const Mat3 axes = placement.rotation.toRotationMatrix();
  if (description.center_of_mass_B && description.mass_kg) {
    return {.mass_kg = *description.mass_kg,
            .center_O = placement.position_m + axes * *description.center_of_mass_B,
            .inertia_C = axes * inertia_of_numbers(description.inertia_kg_m2) * axes.transpose()};
  }
  const auto* const primitive = std::get_if<rendering::Primitive>(&shape);
  MassProperties properties =
      primitive != nullptr
          ? moved_by(primitive_mass_properties(*primitive, description.density_kg_per_m3),
                     primitive->X_WO)
          : mass_of_mesh(description, mesh);
  if (description.mass_kg) {
    properties = with_mass(properties, *description.mass_kg);
  }
  if (!description.inertia_kg_m2.empty()) {
    properties.inertia_C = axes * inertia_of_numbers(description.inertia_kg_m2) * axes.transpose();
  }
  return properties;
}

// Returns the edges of faces: each is in two of them, once in each direction.
std::vector<rendering::HullEdge> edges_of(const ConvexHull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint16_t> face_left_of;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const auto& corners = hull.faces[f].vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      face_left_of[{corners[i], corners[(i + 1) % corners.size()]}] = static_cast<std::uint16_t>(f);
    }
  }
  std::vector<rendering::HullEdge> edges;
  for (const auto& [edge, left] : face_left_of) {
    if (edge.first < edge.second) {
      edges.push_back({.from = static_cast<std::uint16_t>(edge.first),
                       .to = static_cast<std::uint16_t>(edge.second),
                       .left = left,
                       .right = face_left_of.at({edge.second, edge.first})});
    }
  }
  return edges;
}

// Returns the hull of the mesh, and tells where bodies meet it and not the shape.
BakedHull hull_of(const BakedMesh& mesh, std::vector<std::string>& warnings) {
  // A shape that fills less of its hull is not taken for convex.
  constexpr double kConvexShare = 0.97;
  constexpr double kTold_m = 1e-5;
  const ConvexHull hull = convex_hull(std::span<const rendering::Float3>(mesh.vertices));
  const double of_shape =
      mesh_mass_properties(std::span<const rendering::Float3>(mesh.vertices), mesh.triangles, 1.0)
          .mass_kg;
  const double of_hull =
      mesh_mass_properties(std::span<const Vec3>(hull.vertices), to_triangles(hull), 1.0).mass_kg;
  if (of_shape < kConvexShare * of_hull) {
    warnings.push_back(fmt::format(
        "other objects meet its convex hull, which is {:.0f} % larger; fingers feel the shape "
        "itself",
        100.0 * (of_hull / of_shape - 1.0)));
  }
  if (hull.left_out_m > kTold_m) {
    warnings.push_back(
        fmt::format("other objects meet its convex hull of {} vertices, which leaves out {:.2g} mm",
                    hull.vertices.size(), hull.left_out_m / kMillimetre_m));
  }
  return arrays_of(hull);
}

}  // namespace

BakedHull arrays_of(const ConvexHull& hull) {
  BakedHull baked{.vertices = hull.vertices, .faces = {}, .corners = {}, .edges = edges_of(hull)};
  for (const ConvexHull::Face& face : hull.faces) {
    baked.faces.push_back({.normal_O = face.normal,
                           .first = static_cast<std::uint32_t>(baked.corners.size()),
                           .count = static_cast<std::uint32_t>(face.vertices.size())});
    std::ranges::transform(face.vertices, std::back_inserter(baked.corners),
                           [](std::uint32_t i) { return static_cast<std::uint8_t>(i); });
  }
  return baked;
}

BakedBody bake_body(const BodyDescription& description, const ShapeDescription& shape,
                    const Placement& placement, const BakedMesh& mesh,
                    std::vector<std::string>& warnings) {
  const Mat3 axes = placement.rotation.toRotationMatrix();
  const MassProperties properties = mass_of(description, shape, mesh, placement);
  BakedBody baked{.body = {.mass = {.mass_kg = properties.mass_kg,
                                    .center_O = properties.center_O,
                                    .inertia_C = properties.inertia_C,
                                    .linear_damping_per_s = description.linear_damping_per_s,
                                    .angular_damping_per_s = description.angular_damping_per_s},
                           .hull = {},
                           .first_part = 0,
                           .part_count = 0,
                           .axes_O = axes,
                           .restitution = description.restitution,
                           .rolling_friction_m = description.rolling_friction_m,
                           .spinning_friction_m = description.spinning_friction_m,
                           .velocity_W = description.velocity_W,
                           .angular_velocity_O = axes * description.angular_velocity_B},
                  .hull = {},
                  .parts = {}};
  if (!rendering::valid(baked.body.mass)) {
    throw InputError(fmt::format(
        "a body of {:.3g} kg with such an inertia cannot be computed; is it in metres and "
        "kilograms, and not thinner than a thousandth of its length?",
        properties.mass_kg));
  }
  const auto* const primitive = std::get_if<rendering::Primitive>(&shape);
  const bool is_own_hull = primitive != nullptr && rendering::has_hull(primitive->kind);
  if (description.parts.empty() && !is_own_hull) {
    baked.hull = hull_of(mesh, warnings);
  }
  return baked;
}

}  // namespace tactus::host
