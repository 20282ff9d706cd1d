// One object of a scene: views of memory that the caller keeps alive and unchanged. Nothing here
// owns or copies.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/material/material.h"
#include "rendering/material/surface_detail.h"
#include "rendering/objects/motion.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

inline constexpr std::uint32_t kNoObject = 0xffffffff;

enum class SurfaceKind : std::uint8_t { mesh = 0, primitive = 1, implicit = 2 };

// The contact method: it keeps the tool out of an object, or pushes it out.
enum class ContactMethod : std::uint8_t {
  sphere_proxy = 0,     // a proxy with the tool's radius; meshes and primitives
  god_object = 1,       // a point proxy: to this object the tool has no radius
  potential_field = 2,  // the baseline, with its faults: closed meshes and primitives
  feature_walk = 3,     // a point that walks from feature to feature; meshes
  tracking = 4,         // a point that follows the tangent plane; implicit surfaces
};

struct Object {
  SurfaceKind surface = SurfaceKind::mesh;
  ContactMethod method = ContactMethod::sphere_proxy;
  MeshView mesh;  // of these three, the one that `surface` names
  Primitive primitive;
  ImplicitSurface implicit;  // its `sides` are the object's too
  // The neighbours and vertex normals of the mesh (see ConnectedMesh), needed by potential_field
  // and feature_walk.
  std::span<const std::array<std::uint32_t, 3>> neighbours;
  std::span<const Float3> vertex_normals;
  Sides sides = Sides::one;
  Material material;
  SurfaceDetail detail;  // not of a potential field; of a mesh that deforms, its textures alone
  bool moves = false;    // the outside moves it: the scene's frame is then its own frame
  bool deforms = false;  // and its vertices; a mesh that the shared proxy meets
  // The object's own motion until the outside takes over; nullptr for none. Waves need
  // vertex_normals.
  const Motion* motion = nullptr;
};

// Returns the smallest axis-parallel box of the object, in the frame of the scene; for a plane the
// whole world.
Bounds bounds_of(const Object& object);

// Returns true if the surface is sound and its contact method can touch it.
bool usable(const Object& object);

inline bool meets_proxy(const Object& object) {
  return object.method == ContactMethod::sphere_proxy || object.method == ContactMethod::god_object;
}

inline bool is_mover(const Object& object) {
  return object.moves || object.deforms;
}

inline bool is_point_tool(const Object& object) {
  return object.method == ContactMethod::god_object;
}

}  // namespace tactus::rendering
