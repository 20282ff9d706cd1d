// Transfers plain structs of rendering through a StateArchive. Each function names all members: a
// new member fails to compile here until it is handled. The transfers of the classes that hold
// these structs call them.
#pragma once

#include "rendering/contact/last_contact.h"
#include "rendering/effects/effect.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/capsule.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/triangle.h"
#include "rendering/objects/motion.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/state_archive.h"
#include "rendering/surface/connected_mesh.h"
#include "rendering/touch.h"

namespace tactus::rendering {

inline void transfer(StateArchive& archive, FrictionParameters& friction) {
  auto& [kind, coulomb, static_level, viscous_s_per_m, stribeck_velocity_m_per_s, stribeck_exponent,
         stiffness_N_per_m, damping_s_per_m, damping_fade_m_per_s, stick_velocity_m_per_s,
         elastic_fraction] = friction;
  archive.choice(kind, static_cast<FrictionKind>(kFrictionKinds - 1));
  archive(coulomb, static_level, viscous_s_per_m, stribeck_velocity_m_per_s, stribeck_exponent,
          stiffness_N_per_m, damping_s_per_m, damping_fade_m_per_s, stick_velocity_m_per_s,
          elastic_fraction);
}

inline void transfer(StateArchive& archive, RigidPose& pose) {
  auto& [rotation, translation] = pose;
  archive(rotation, translation);
}

inline void transfer(StateArchive& archive, Twist& twist) {
  auto& [linear_W, angular_W] = twist;
  archive(linear_W, angular_W);
}

inline void transfer(StateArchive& archive, Bounds& bounds) {
  auto& [lower_W, upper_W] = bounds;
  archive(lower_W, upper_W);
}

inline void transfer(StateArchive& archive, Capsule& capsule) {
  auto& [start, axis, radius] = capsule;
  archive(start, axis, radius);
}

inline void transfer(StateArchive& archive, Plane& plane) {
  auto& [normal, offset] = plane;
  archive(normal, offset);
}

inline void transfer(StateArchive& archive, ToolState& tool) {
  auto& [p_W, v_W] = tool;
  archive(p_W, v_W);
}

inline void transfer(StateArchive& archive, Nearest& nearest) {
  auto& [distance, normal, feature, edge] = nearest;
  archive(distance, normal);
  archive.choice(feature, Feature::vertex);
  archive.up_to(edge, 2);
}

inline void transfer(StateArchive& archive, MeshFeature& place) {
  auto& [kind, number, triangle] = place;
  archive.choice(kind, Feature::vertex);
  archive.up_to(number, 2);
  archive(triangle);
}

template <class Vector>
void transfer(StateArchive& archive, FrictionMemory<Vector>& memory) {
  auto& [elastic_force_N, slipping, left_band] = memory;
  archive(elastic_force_N, slipping, left_band);
}

inline void transfer(StateArchive& archive, EffectState& state) {
  auto& [last_tool_W, held_force_W, delivered_J, anchor_W, phase, started] = state;
  archive(last_tool_W, held_force_W, delivered_J, anchor_W, phase, started);
}

// Refuses the state unless the shared proxy meets such an object and its mesh has such a triangle.
inline void require_place(StateArchive& archive, const SceneObjects& scene, std::uint32_t object,
                          std::uint32_t triangle) {
  archive.require(object < scene.size());
  archive.require(archive.good() && meets_proxy(scene[object]) &&
                  (scene[object].surface != SurfaceKind::mesh ||
                   triangle < scene[object].mesh.triangles.size()));
}

}  // namespace tactus::rendering
