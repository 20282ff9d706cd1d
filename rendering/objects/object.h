// One object of a scene: views of memory that the caller keeps alive and unchanged. Nothing here
// owns or copies. SceneImage (rendering/scene) makes objects of a baked scene, a program that
// embeds the library makes its own, and World::set_scene takes them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/mesh.h"
#include "rendering/material/material.h"
#include "rendering/material/surface_detail.h"
#include "rendering/objects/contact_method.h"
#include "rendering/objects/motion.h"
#include "rendering/surface/implicit_surface.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// Numbers no object of a scene.
inline constexpr std::uint32_t kNoObject = 0xffffffff;
// Numbers no body of a scene.
inline constexpr std::uint8_t kNoBody = 0xff;
// Numbers no tissue of a scene.
inline constexpr std::uint8_t kNoTissue = 0xff;

// The push-out of a textbook's method where none is given, m.
inline constexpr double kDefaultPushOut_m = 1e-6;

// An object: its surface, the method by which it is touched, its material and its motion.
struct Object {
  // The surface that is touched, and the method.
  SurfaceKind surface = SurfaceKind::mesh;
  ContactMethod method = ContactMethod::sphere_proxy;
  // The surface in each of its kinds; the one that `surface` names is used. The mesh of another
  // kind is only its picture.
  MeshView mesh;
  Primitive primitive;
  // The formula; its `sides` are the object's too.
  ImplicitSurface implicit;
  // The neighbours and vertex normals of the mesh (see ConnectedMesh), needed by potential_field
  // and feature_walk.
  std::span<const std::array<std::uint32_t, 3>> neighbours;
  std::span<const Float3> vertex_normals;
  // The sides that stop the tool.
  Sides sides = Sides::one;
  // The height above a facet where the textbook's methods put their point, m, >= 0.
  double push_out_m = kDefaultPushOut_m;
  // The material at the start; World::set_material may change it.
  Material material;
  // Normals and textures. A potential field and the textbook's methods have none; a mesh that
  // deforms uses its textures alone.
  SurfaceDetail detail;
  // True if the outside or a motion moves the object: the frame in which it is given is then its
  // own frame O.
  bool moves = false;
  // True if its vertices move too; it must be a mesh that the shared proxy meets.
  bool deforms = false;
  // The object's own motion until the outside takes over; nullptr for none. Waves need
  // vertex_normals.
  const Motion* motion = nullptr;
  // The number of the ObjectBody (WorldConfig::bodies) that makes it a body, which moves by forces;
  // kNoBody for none. A body `moves`, shares the proxy, and has no motion of its own.
  std::uint8_t body = kNoBody;
  // The number of the Tissue (WorldConfig::needle) that makes it a layer which a needle pierces;
  // kNoTissue for none. A needle alone meets such an object; its method and material do nothing.
  std::uint8_t tissue = kNoTissue;
};

// Returns the smallest axis-parallel box of the object, in the frame of the scene; for a plane the
// whole world.
Bounds bounds_of(const Object& object);

// Returns true if the surface is sound and its contact method can touch it.
bool usable(const Object& object);

// Returns true if a usable() object could be touched by that method in place of its own, with that
// material. Baking applies the same rules to the keys of a scene.
bool can_render(ContactMethod method, const Object& object, const Material& material);

// Returns true if the object is a layer that a needle pierces.
inline bool is_tissue(const Object& object) {
  return object.tissue != kNoTissue;
}

// Returns true if the object shares the proxy with others, false if it gives its own force or is
// tissue.
inline bool meets_proxy(const Object& object) {
  return meets_proxy(object.method) && !is_tissue(object);
}

// Returns true if the object gives its own force on the tool.
inline bool is_independent(const Object& object) {
  return !meets_proxy(object.method) && !is_tissue(object);
}

// Returns true if the object may change its place or shape.
inline bool is_mover(const Object& object) {
  return object.moves || object.deforms;
}

// Returns true if the object moves by forces.
inline bool is_body(const Object& object) {
  return object.body != kNoBody;
}

// Returns true if the tool has no radius to this object.
inline bool is_point_tool(const Object& object) {
  return object.method == ContactMethod::god_object;
}

}  // namespace tactus::rendering
