// Friction under a proxy that several surfaces hold at once, each with a model of its own.
//
// Every model runs under its own part of the normal force, and the forces add up: the proxy slips
// where each has slipped, under the sum of what they take. The springs by which the surfaces stick,
// and their bristles, are lessened in proportion to the force that each can hold. So the whole
// contact is as stiff as one surface, two surfaces of one material hold a proxy as one does, and
// all of them begin to slip together. A surface that is about to let go, whose part of the normal
// force goes to zero, takes no part in the force any more: it changes continuously.
//
// When the parts change, every bristle keeps its deflection z, and one of a surface that joins the
// contact takes the mean of the others. Then all are scaled so that neither the energy of the
// bristles nor their joint force grows. Where all deflections are equal that scale is 1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "rendering/friction/surface_friction.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// One of the surfaces that hold the proxy.
struct JointSurface {
  // The number by which the surface is known again in the next tick.
  std::uint32_t number = 0;
  // Its share is set by JointFriction.
  SlidingSurface sliding;
  // Its part of the normal force, N.
  double normal_force_N = 0.0;
};

// The friction of one contact with up to kMost surfaces.
class JointFriction {
 public:
  static constexpr std::size_t kMost = 3;

  // Turns the bristles with their surfaces by a rotation, before a tick begins.
  void turn_by(const Mat3& rotation);

  // Sets the tool's step since the last tick relative to the contact (m), and its duration (s).
  // Call it first in a tick.
  void begin_tick(const Vec3& tool_step, double tick_s);

  // Returns the joint lag of a contact with the unit `normal`. The first
  // call in a tick runs the models; a surface that joins in a later one has no force before the
  // next tick. A new surface goes on where one was that holds the proxy no more. `surfaces` are at
  // most kMost of different numbers.
  FrictionLag lag(std::span<JointSurface> surfaces, const Vec3& normal);

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  static constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

  void begin_models();
  // Turns all bristles to the plane with the unit `normal`; `sliding` is one of the surfaces.
  void turn_models(const SlidingSurface& sliding, const Vec3& normal);
  [[nodiscard]] bool has_run() const;
  [[nodiscard]] std::size_t place_of(std::uint32_t surface) const;
  void give_models(std::span<const JointSurface> surfaces, bool to_all);
  void share_bristles(std::span<const JointSurface> surfaces, const Vec3& normal);

  // The surfaces, and the models that they hold the proxy by.
  std::array<std::uint32_t, kMost> surfaces_{kNoSurface, kNoSurface, kNoSurface};
  std::array<SurfaceFriction, kMost> models_;
  // True if a model has run in this tick or the last; else they are not touched.
  bool is_in_use_ = false;
  // The plane of the contact, and the depth in it.
  Vec3 normal_ = Vec3::Zero();
  double depth_m_ = 0.0;
  Vec3 tool_step_ = Vec3::Zero();
  double tick_s_ = 1e-3;
};

}  // namespace tactus::rendering
