// Friction under a proxy: from the tool's motion to how far the proxy lags.
//
// The proxy without friction, p_s, is the point of the surface nearest to the tool; K (p_s - tool)
// is the normal force. A tangential force F on the tool takes the proxy to p_s - F / K, since the
// tool feels K (proxy - tool): the lag is F / K whatever the model. The model is driven by the
// tool's own step along the contact plane, seen from the surface, so that what friction takes from
// the tool is the model's work F . dx, and the model's passivity is the tool's. On a plane p_s
// moves as the tool does.
//
// The friction cone is the limit of a rigid contact: what sticks does not move, so that the tool
// stretches the K of the proxy alone. A model that sticks by a spring of its own (the cone,
// Coulomb, Stribeck, Karnopp) is therefore given K for that spring where it has none, and then
// holds the proxy still: F grows by K dx, the lag by dx. Dahl's and LuGre's bristles are in the
// place of that spring: one of stiffness sigma0 < K lets the proxy creep along by the share
// 1 - sigma0 / K of the tool's step before it slips.
//
// Contact that is made starts without force, and what is left of a force when the normal force
// falls is cut with it (friction_model.h): neither can kick. Where the contact plane turns, the
// force turns with it, and is lessened where the tool is deeper below the new plane (share_kept()).
// Plane and force turn with an object that turns.
#pragma once

#include <algorithm>
#include <cmath>

#include "rendering/friction/cone.h"
#include "rendering/friction/friction_model.h"
#include "rendering/friction/grain.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {

// The surface that the proxy slides on, in the frame of the contact.
struct SlidingSurface {
  FrictionParameters friction;
  double stiffness_N_per_m = 0.0;  // K >= 0
  // The distance of the tool from where the proxy would be without friction, m.
  double depth_m = 0.0;
  Grain grain;  // its direction need not lie in the contact plane
  // The part of the contact's bristle that is this surface's: 1, or less if others hold the proxy
  // too (joint_friction.h).
  double share = 1.0;
  // The direction in which alone the contact can move, unit, if two planes hold the proxy; zero if
  // it moves along a plane. The tool's motion across it takes nothing along.
  Vec3 crease = Vec3::Zero();
};

// Returns the stiffness of the bristle of a surface of the stiffness K, N/m: its own, or else K. A
// cone has K.
constexpr double bristle_stiffness(const FrictionParameters& friction, double stiffness_N_per_m) {
  const bool has_own = friction.kind != FrictionKind::cone && friction.stiffness_N_per_m > 0.0;
  return has_own ? friction.stiffness_N_per_m : stiffness_N_per_m;
}

// Returns the stiffness of the surface's part of the bristle, N/m.
constexpr double bristle_stiffness(const SlidingSurface& surface) {
  return surface.share * bristle_stiffness(surface.friction, surface.stiffness_N_per_m);
}

// A contact whose plane turns while the tool stands still. The spring of the depth d stores
// K d^2 / 2, and the bristles what they do.
struct TurningContact {
  // Twice the energy of the bristles over K, m^2.
  double bristle_m2 = 0.0;
  // The depth before the turn and after it, m.
  double before_m = 0.0;
  double now_m = 0.0;
};

// Returns the share of the bristles' force that a turn of the contact plane leaves. A tool that
// stands still adds no energy, so that a plane under which the tool is deeper has less friction.
// Without this a proxy that goes round an edge would stretch both.
inline double share_kept(const TurningContact& contact) {
  const double gained_m2 = contact.now_m * contact.now_m - contact.before_m * contact.before_m;
  if (!(gained_m2 > 0.0) || !(contact.bristle_m2 > 0.0)) {
    return 1.0;
  }
  return std::sqrt(std::max(1.0 - gained_m2 / contact.bristle_m2, 0.0));
}

// Returns the depth of a contact after a step of the tool relative to it, m: along the unit
// `normal`, or, in a crease, by all of the step across it.
inline double moved_depth_m(double depth_m, const Vec3& normal, const Vec3& crease,
                            const Vec3& step) {
  if (crease == Vec3::Zero()) {
    return std::max(depth_m - normal.dot(step), 0.0);
  }
  return (depth_m * normal - step + crease.dot(step) * crease).norm();
}

// The elastic force of a bristle and its stiffness.
struct Bristle {
  Vec3 force_N = Vec3::Zero();
  double stiffness_N_per_m = 0.0;
};

struct FrictionLag {
  Vec3 lag_m = Vec3::Zero();  // tangential, along the tool's motion: the proxy is at p_s less this
  FrictionState state = FrictionState::stick;
};

class SurfaceFriction {
 public:
  // Turns the bristle with its surface by a rotation, before a tick begins.
  void turn_by(const Mat3& rotation);

  // Sets the tool's step since the last tick relative to the surface (m), and its duration (s).
  // Call it first in a tick. A contact for which `lag` was not called in the last tick has ended.
  void begin_tick(const Vec3& tool_step, double tick_s);

  // Returns the lag of a contact with the unit `normal`. The first call in a tick runs the model;
  // later calls turn its force to their plane and lessen it with the share. The lag is zero without
  // a normal force or without K.
  FrictionLag lag(const SlidingSurface& surface, const Vec3& normal, double normal_force_N);

  // Returns true if the model has run in this tick.
  [[nodiscard]] bool has_run() const { return ran_; }
  // Returns 2 if the model has run in this tick, 1 if it ran in the last one only, else 0.
  [[nodiscard]] int recency() const { return ran_ ? 2 : static_cast<int>(is_held_); }

  // Turns the bristle of a contact that goes on to the plane with the unit `normal`, and lessens it
  // to a share (share_kept()).
  void turn_to(const Vec3& normal, double share);
  // Returns twice the energy of the bristle; 0 if the contact begins in this tick.
  [[nodiscard]] double twice_stored_J() const;

  // Returns the bristle in the plane with the unit `normal`, before the model runs; one without
  // stiffness if the contact begins in this tick.
  [[nodiscard]] Bristle bristle(const Vec3& normal) const;
  // Sets the bristle of a contact that goes on in the plane with the unit `normal`.
  void set_bristle(const Bristle& bristle, const Vec3& normal);

  // Saves the state to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  // Turns the bristle to a new plane of the surface; `before_m` is the depth below the old one.
  void turn_plane(const SlidingSurface& surface, const Vec3& normal, double before_m);
  void run(const SlidingSurface& surface, const Vec3& normal, double normal_force_N);

  FrictionMemory<Vec3> memory_;
  Vec3 normal_ = Vec3::Zero();  // of the bristle's plane
  double depth_m_ = 0.0;        // in that plane
  Vec3 force_N_ = Vec3::Zero();
  double stiffness_N_per_m_ = 0.0;  // of the bristle in the last run
  double share_ = 1.0;              // the surface's share in the last run
  Vec3 tool_step_ = Vec3::Zero();
  double tick_s_ = 1e-3;
  FrictionState state_ = FrictionState::free;
  bool ran_ = false;      // in this tick
  bool is_held_ = false;  // it ran in the last tick
};

}  // namespace tactus::rendering
