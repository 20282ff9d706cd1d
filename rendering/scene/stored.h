// Converts the types of the generated schema to rendering's types. It is for the .cpp files of this
// folder only.
#pragma once

#include <cstdint>
#include <span>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::rendering {

// Returns true if the vector can be used in place. FlatBuffers' verifier asks for the alignment of
// a vector's length alone, four bytes; structs with doubles need eight.
template <class Stored>
bool is_aligned(const flatbuffers::Vector<const Stored*>* stored) {
  return stored == nullptr ||
         reinterpret_cast<std::uintptr_t>(stored->Data()) % alignof(Stored) == 0;
}

// Returns a FlatBuffers vector of structs, aligned, as the house's own type of the same bytes; an
// empty span if it is absent.
template <class T, class Stored>
std::span<const T> in_place(const flatbuffers::Vector<const Stored*>* stored) {
  static_assert(sizeof(T) == sizeof(Stored) && alignof(T) == alignof(Stored));
  if (stored == nullptr) {
    return {};
  }
  const void* data = stored->Data();
  return {static_cast<const T*>(data), stored->size()};
}

// Returns a single stored struct, or nullptr if it is absent.
template <class T, class Stored>
const T* in_place(const Stored* stored) {
  static_assert(sizeof(T) == sizeof(Stored) && alignof(T) == alignof(Stored));
  const void* data = stored;
  return static_cast<const T*>(data);
}

// Returns the stored vector.
inline Vec3 to_vec3(const image::Double3& v) {
  return {v.x(), v.y(), v.z()};
}

// Returns the stored pose, unchecked: the columns of its rotation are the axes of O in the world.
inline RigidPose to_pose(const image::Pose& stored) {
  RigidPose pose;
  pose.rotation << to_vec3(stored.x_axis()), to_vec3(stored.y_axis()), to_vec3(stored.z_axis());
  pose.translation = to_vec3(stored.origin());
  return pose;
}

}  // namespace tactus::rendering
