// How far a sphere can travel along a straight line before it touches an object, over any length.
#pragma once

#include <cstdint>

#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/world/scene_objects.h"

namespace tactus::rendering {

// In the object's own frame O.
struct ObjectSweep {
  Sweep sweep_O;
  double limit_m = 0.0;
};

struct ObjectHit {
  double travel_m = 0.0;       // that is free
  bool met = false;            // the object stops the sphere there
  std::uint32_t triangle = 0;  // of a mesh
};

// `room` is for how much work there is room, in units of kMaxTickBudget; what is done is taken from
// it. When it runs out the travel ends where the walk ended, and nothing is met.
ObjectHit sweep_object(const SceneObjects& scene, std::uint32_t number, const ObjectSweep& sweep,
                       const ContactMargin& margin, std::size_t& cost_left);

// The nearest point of the object, or of one triangle of its mesh, from p_O; in the object's frame.
Nearest nearest_at(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle,
                   const Vec3& p_O);

// The first of all objects that stops the sphere.
struct FirstHit {
  double travel_m = 0.0;  // that is free
  std::uint32_t object = kNoObject;
  std::uint32_t triangle = 0;
};

// The same over the objects that stand still, and over all objects where they are in this tick, but
// for those that are left out.
FirstHit sweep_still_objects(const SceneObjects& scene, const ContactMargins& margins,
                             const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                             const LeftOut& left_out = {});
FirstHit sweep_all_objects(const SceneObjects& scene, const ContactMargins& margins,
                           const Sweep& sweep_W, double limit_m, std::size_t& cost_left,
                           const LeftOut& left_out = {});

}  // namespace tactus::rendering
