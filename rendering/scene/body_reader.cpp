#include "rendering/scene/body_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rendering/bodies/primitive_hull.h"
#include "rendering/bodies/rigid_body.h"
#include "rendering/limits.h"
#include "rendering/scene/shape_reader.h"
#include "rendering/scene/stored.h"

namespace tactus::rendering {
namespace {

static_assert(sizeof(HullFace) == sizeof(image::HullFace) && offsetof(HullFace, first) == 24 &&
              sizeof(HullEdge) == sizeof(image::HullEdge) && offsetof(HullEdge, right) == 6 &&
              sizeof(Vec3) == sizeof(image::Double3));

bool is_turn_friction(double friction_m) {
  return friction_m >= 0.0 && friction_m <= kMostTurnFriction_m;
}

bool is_unit(const Vec3& v) {
  return std::abs(v.squaredNorm() - 1.0) <= 1e-6;
}

// Returns true if every number of the hull refers to something: a solver needs no tests then.
bool is_hull(const ConvexHull& hull) {
  const std::size_t vertices = hull.vertices_O.size();
  const auto is_vertex = [&](std::size_t i) { return i < vertices; };
  const auto is_good_face = [&](const HullFace& face) {
    return is_unit(face.normal_O) && face.count >= 3 && face.count <= kMaxHullVertices &&
           std::uint64_t{face.first} + face.count <= hull.corners.size();
  };
  const auto is_good_edge = [&](const HullEdge& edge) {
    return is_vertex(edge.from) && is_vertex(edge.to) && edge.left < hull.faces.size() &&
           edge.right < hull.faces.size();
  };
  return vertices <= kMaxHullVertices &&
         std::ranges::all_of(hull.vertices_O,
                             [](const Vec3& v) {
                               return v.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
                             }) &&
         hull.faces.size() <= 2 * kMaxHullVertices && hull.edges.size() <= 3 * kMaxHullVertices &&
         std::ranges::all_of(hull.faces, is_good_face) &&
         std::ranges::all_of(hull.corners, is_vertex) &&
         std::ranges::all_of(hull.edges, is_good_edge);
}

// Returns the hull of a body or a part, used in place; nothing if its arrays are not aligned.
template <class Stored>
std::optional<ConvexHull> read_hull(const Stored& stored) {
  if (!is_aligned(stored.hull_vertices()) || !is_aligned(stored.hull_faces())) {
    return std::nullopt;
  }
  ConvexHull hull{.vertices_O = in_place<Vec3>(stored.hull_vertices()),
                  .faces = in_place<HullFace>(stored.hull_faces()),
                  .corners = {},
                  .edges = in_place<HullEdge>(stored.hull_edges())};
  if (stored.hull_corners() != nullptr) {
    hull.corners = {stored.hull_corners()->data(), stored.hull_corners()->size()};
  }
  return hull;
}

Mat3 to_matrix(const image::Inertia& stored) {
  Mat3 m;
  m << stored.xx(), stored.xy(), stored.xz(), stored.xy(), stored.yy(), stored.yz(), stored.xz(),
      stored.yz(), stored.zz();
  return m;
}

}  // namespace

Vec3 read_gravity(const image::Double3* stored) {
  if (stored == nullptr || !(to_vec3(*stored).norm() <= kMostGravity_m_per_s2)) {
    return standard_gravity_W();
  }
  return to_vec3(*stored);
}

double read_finger_modulus(double stored) {
  return is_finger_modulus(stored) ? stored : 0.0;
}

double read_sleep_time(double stored) {
  return is_sleep_time(stored) ? stored : 0.0;
}

std::expected<ObjectBody, SceneError> read_body(const image::Body& stored, const Object& object) {
  const std::optional<ConvexHull> hull = read_hull(stored);
  if (!hull) {
    return fail(SceneFault::malformed);
  }
  ObjectBody body{.mass = {.mass_kg = stored.mass(),
                           .center_O = to_vec3(*stored.center()),
                           .inertia_C = to_matrix(*stored.inertia()),
                           .linear_damping_per_s = stored.linear_damping(),
                           .angular_damping_per_s = stored.angular_damping()},
                  .hull = *hull,
                  .part_count = stored.parts() == nullptr ? 0 : stored.parts()->size(),
                  .axes_O = to_pose(*stored.axes()).rotation,
                  .restitution = stored.restitution(),
                  .rolling_friction_m = stored.rolling_friction(),
                  .spinning_friction_m = stored.spinning_friction(),
                  .velocity_W = to_vec3(*stored.velocity()),
                  .angular_velocity_O = to_vec3(*stored.angular_velocity())};
  const bool has_shape =
      body.part_count > 0 || !body.hull.vertices_O.empty() ||
      (object.surface == SurfaceKind::primitive && has_hull(object.primitive.kind));
  const bool is_good = has_shape && valid(body.mass) && is_hull(body.hull) &&
                       body.axes_O.allFinite() && body.restitution >= 0.0 &&
                       body.restitution <= 1.0 && is_turn_friction(body.rolling_friction_m) &&
                       is_turn_friction(body.spinning_friction_m) &&
                       body.mass.center_O.cwiseAbs().maxCoeff() <= kWorldBound_m &&
                       body.velocity_W.norm() <= kFastestBody_m_per_s &&
                       body.angular_velocity_O.norm() <= kFastestBodyTurn_rad_per_s;
  if (!is_good) {
    return fail(SceneFault::body);
  }
  return body;
}

std::expected<BodyPart, SceneError> read_body_part(const image::BodyPart& stored) {
  const std::optional<ConvexHull> hull = read_hull(stored);
  if (!hull) {
    return fail(SceneFault::malformed);
  }
  if (stored.primitive() == nullptr) {
    if (hull->vertices_O.empty() || !is_hull(*hull)) {
      return fail(SceneFault::body_part);
    }
    return BodyPart{.hull = *hull, .primitive = {}};
  }
  const std::optional<Primitive> primitive = read_primitive(*stored.primitive());
  if (!primitive || !has_hull(primitive->kind)) {
    return fail(SceneFault::body_part);
  }
  return BodyPart{.hull = {}, .primitive = *primitive};
}

}  // namespace tactus::rendering
