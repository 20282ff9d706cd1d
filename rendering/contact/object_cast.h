// How far a sphere can travel along a straight line before it touches an object, over any length.
#pragma once

#include <cstdint>

#include "rendering/contact/left_out.h"
#include "rendering/contact/sphere_sweep.h"
#include "rendering/world/scenery.h"

namespace tactus::rendering {

// In the object's own frame O.
struct ObjectCast {
  Sweep sweep_O;
  double limit_m = 0.0;
};

struct ObjectHit {
  double travel_m = 0.0;       // that is free
  bool met = false;            // the object stops the sphere there
  std::uint32_t triangle = 0;  // of a mesh
};

// `room` is for how much work there is room, in units of kMaxWork; what is done is taken from it.
// When it runs out the travel ends where the walk ended, and nothing is met.
ObjectHit cast_on(const Scenery& scenery, std::uint32_t number, const ObjectCast& cast,
                  const Shell& shell, std::size_t& room);

// The nearest point of the object, or of one triangle of its mesh, from p_O; in the object's frame.
Nearest nearest_at(const Scenery& scenery, std::uint32_t number, std::uint32_t triangle,
                   const Vec3& p_O);

// The first of all objects that stops the sphere.
struct FirstHit {
  double travel_m = 0.0;  // that is free
  std::uint32_t object = kNoObject;
  std::uint32_t triangle = 0;
};

// The same over the objects that stand still, and over all objects where they are in this tick, but
// for those that are left out.
FirstHit cast_on_still(const Scenery& scenery, const Shells& shells, const Sweep& sweep_W,
                       double limit_m, std::size_t& room, const LeftOut& left_out = {});
FirstHit cast_on_all(const Scenery& scenery, const Shells& shells, const Sweep& sweep_W,
                     double limit_m, std::size_t& room, const LeftOut& left_out = {});

}  // namespace tactus::rendering
