// A contact between two bodies, or a body and an obstacle, that lives from tick to tick, and the
// numbers with which it is solved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/manifold.h"
#include "rendering/bodies/push_direction.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The surfaces of a contact.
struct ContactSurface {
  // The coefficient of Coulomb's friction, and that of restitution: the share of the approaching
  // speed that is left after a bounce.
  double friction = 0.0;
  double restitution = 0.0;
  // The torques over the normal force, m, that resist rolling and spinning about the normal.
  double rolling_m = 0.0;
  double spinning_m = 0.0;

  // Returns true if the surface resists turning.
  [[nodiscard]] bool resists_turning() const { return rolling_m > 0.0 || spinning_m > 0.0; }
};

// A point of a contact while it is solved. World frame.
struct SolvedPoint {
  // The arms from the centres of A and B to the point, at the beginning of the tick, m.
  Vec3 arm_a_W = Vec3::Zero();
  Vec3 arm_b_W = Vec3::Zero();
  // The distance of the surfaces then, and in this sub-step, m.
  double separation_m = 0.0;
  double separation_now_m = 0.0;
  // The speed with which the surfaces part at the beginning, m/s; < 0 where they approach.
  double parting_m_per_s = 0.0;
  // The impulses of a sub-step: along the normal, N s, >= 0, and along the tangents.
  double push = 0.0;
  Eigen::Vector2d rub = Eigen::Vector2d::Zero();
  // The share of a free contact's yielding that is left where springs hold a body.
  double yielding = 1.0;
  // The largest push of the tick's sub-steps.
  double hardest_push = 0.0;
  // The normal and the tangents.
  std::array<PushDirection, 3> along;

  // Returns true if the surfaces meet so fast that they hit. Slower approaches, as gravity's of a
  // few ticks, are no hits.
  [[nodiscard]] bool is_hit() const {
    constexpr double kLeastHit_m_per_s = 0.05;
    return parting_m_per_s < -kLeastHit_m_per_s;
  }
};

// The contact of solids `a` and `b`, numbers in the solver's list.
struct BodyContact {
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  // True if A, or both, can be pushed; B always can.
  bool pushes_a = false;
  ContactSurface surface;
  // The normal from A to B and two tangents, unit.
  ContactAxes axes_W{Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
  std::array<SolvedPoint, kManifoldPoints> points;
  std::size_t count = 0;
  // True if a point of it meets so fast in this tick that it hits, and may bounce.
  bool hits = false;
  // The turning about the three axes, and the torques of a sub-step against it, N m s; of surfaces
  // that resist it.
  std::array<PushDirection, 3> about;
  Vec3 torque = Vec3::Zero();
};

// A point of a contact, as the next tick needs it: the arm from the centre of B, m, and the
// impulses along the normal and the two tangents, N s.
struct PastPoint {
  Vec3 arm_b_W = Vec3::Zero();
  double push = 0.0;
  Eigen::Vector2d rub = Eigen::Vector2d::Zero();
};
// A contact, as the next tick needs it.
struct PastContact {
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  ContactAxes axes_W{Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
  std::array<PastPoint, kManifoldPoints> points;
  std::size_t count = 0;
  // The torques about the axes, N m s.
  Vec3 torque = Vec3::Zero();
};

// Returns a contact's past for the next tick.
PastContact past_of(const BodyContact& contact);

// The resistance of a contact to overlap in a sub-step: a damped spring that is integrated
// implicitly (Catto, "Solver2D", 2024). `a1` and `a2` of that text give the three numbers.
struct ContactSoftness {
  // The speed of recovery over the overlap, 1/s.
  double bias_rate = 0.0;
  // The factors of the mass and of the impulse so far.
  double mass_scale = 1.0;
  double impulse_scale = 0.0;
};

// Returns the softness of a spring with this frequency, Hz, and damping ratio in a sub-step.
ContactSoftness contact_softness(double frequency_Hz, double damping_ratio, double step_s);

// Makes a contact of a manifold between the solids that it names. The impulses of `before`, the
// same contact in the last tick or nullptr, go on at the points that are where they were.
void begin_contact(const Manifold& manifold, std::span<const SolverBody> bodies,
                   const PastContact* before, BodyContact& contact);

// The motion of a solid since the beginning of the tick.
struct Shift {
  Vec3 translation_W = Vec3::Zero();
  Mat3 rotation = Mat3::Identity();
};

// Computes the answers and the masses of a contact anew, after springs have taken hold of a body or
// have let go.
void follow_springs(std::span<const SolverBody> bodies, BodyContact& contact);

// Begins a sub-step: applies the impulses that the last one ended with.
void warm_start(BodyContact& contact, std::span<SolverBody> bodies);

// Computes the points' distances after the solids have moved.
void follow_motion(BodyContact& contact, std::span<const Shift> shifts);

// Solves the points of a contact once, or a few times if it hits; friction and the resistance to
// turning come last, as their limit is the push's. With a softness the surfaces are pushed apart
// where they overlap; without one (nullptr) only their approach is stopped.
void solve_contact(BodyContact& contact, std::span<SolverBody> bodies, double step_s,
                   const ContactSoftness* softness);

// Bounces the points that have hit and have been pushed, once. Returns true while that changes
// their impulses.
bool apply_restitution(BodyContact& contact, std::span<SolverBody> bodies);

// Adds the contact's impulses in this sub-step to those on each body, with their torque; `wrenches`
// has a place for every solid.
void add_impulses(const BodyContact& contact, std::span<Vec6> wrenches);

}  // namespace tactus::rendering
