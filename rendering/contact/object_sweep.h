// Sweeps a sphere along a straight line of any length against whole objects. carry_along.cpp sweeps
// against moving objects in their own frames; candidate_sweep.cpp sweeps beyond the candidate set.
#pragma once

#include <cstdint>

#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::rendering {

// A sweep in the object's own frame O, up to `limit_m`.
struct ObjectSweep {
  Sweep sweep_O;
  // The length of the sweep, m.
  double limit_m = 0.0;
};

// The end of a sweep against one object.
struct ObjectHit {
  // The travel that is free, m.
  double travel_m = 0.0;
  // True if the object stops the sphere there; false if the sweep ended, or its budget did.
  bool met = false;
  // The triangle of a mesh that stops the sphere; 0 for a primitive.
  std::uint32_t triangle = 0;
};

// Sweeps against one object. The cost is taken from `cost_left` (cost units, see tick_budget.h).
// When that is used up the travel ends where the search ended, and `met` is false.
ObjectHit sweep_object(const SceneObjects& scene, std::uint32_t number, const ObjectSweep& sweep,
                       const ContactMargin& margin, std::size_t& cost_left);

// Returns the nearest point of the object, or of one triangle of its mesh, from p_O. Everything is
// in the object's frame.
Nearest nearest_at(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle,
                   const Vec3& p_O);

// The first object that blocks the sphere.
struct FirstHit {
  // The travel that is free, m.
  double travel_m = 0.0;
  // The object that stops the sphere there; kNoObject if none does, or if the budget ended the
  // sweep.
  std::uint32_t object = kNoObject;
  std::uint32_t triangle = 0;
};

// Sweep against the objects at rest, and against all objects where they are in this tick. Objects
// in `left_out` are ignored. The cost is taken from `cost_left` as in sweep_object.
FirstHit sweep_still_objects(const SceneObjects& scene, const ContactMargins& margins,
                             const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                             const LeftOut& left_out = {});
FirstHit sweep_all_objects(const SceneObjects& scene, const ContactMargins& margins,
                           const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                           const LeftOut& left_out = {});

}  // namespace tactus::rendering
