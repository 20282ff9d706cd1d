// Solves a tick of bodies in sub-steps: their velocities under gravity, contacts and fingers, and
// their motion.
//
// Each sub-step (Catto, "Solver2D", 2024) accelerates the bodies, starts with the impulses of the
// last one, solves every contact with soft recovery from overlaps, moves the bodies, and solves
// every contact again without recovery, so that recovery gives no energy. Restitution comes last.
// The order is that of the bodies' numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/finger_grip.h"
#include "rendering/bodies/solid_list.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// The parts of a tick that is solved.
struct SolvedTick {
  SolidList& solids;
  // The numbers of the bodies that are awake.
  std::span<const std::uint8_t> awake;
  std::span<BodyContact> contacts;
  FingerGrips& grips;
  // Gravity, m/s^2, and the length of a sub-step.
  Vec3 gravity_W = Vec3::Zero();
  double step_s = 0.0;

  // Returns true if fingers hold a body of a contact.
  [[nodiscard]] bool is_held(const BodyContact& contact) const {
    return grips.holds(contact.a) || grips.holds(contact.b);
  }
};

// Lives in static storage; no heap.
class BodySolver {
 public:
  // The sub-steps of a tick.
  static constexpr int kSubSteps = 4;

  // Takes the velocities of a body, or of the obstacles, at the beginning of a tick.
  void take_body(const SolidList& solids, std::size_t body);
  void take_obstacles(const SolidList& solids);
  // Returns the velocities of all solids.
  [[nodiscard]] std::span<SolverBody> velocities() { return velocities_; }

  // Solves and moves the bodies of a tick, whose solids are taken and whose contacts are found.
  void solve(const SolvedTick& tick);

 private:
  // Computes one sub-step; the last one has the bounces.
  void sub_step(const SolvedTick& tick, bool is_last);
  // Solves the springs of the fingers for the impulses that the contacts have now.
  void hold_bodies(const SolvedTick& tick);
  // Solves all contacts, with recovery from overlaps or without (nullptr).
  void solve_contacts(const SolvedTick& tick, const ContactSoftness* softness);
  // Bounces what has hit.
  void bounce(std::span<BodyContact> contacts);
  // Sums up the impulses on the bodies in this sub-step.
  void sum_impulses(const SolvedTick& tick);
  // Moves the bodies by the velocities that are solved so far.
  void move_bodies(const SolvedTick& tick);

  std::array<SolverBody, SolidList::kMostSolids> velocities_;
  std::array<Shift, SolidList::kMostSolids> shifts_;
  // The impulses of the contacts on each solid in this sub-step.
  std::array<Vec6, SolidList::kMostSolids> pushed_;
  // The velocities with which each body has moved in this sub-step.
  std::array<Vec6, kMaxBodies> moved_;
  // The impulses of contacts for which the springs of a body are solved.
  std::array<Vec6, kMaxBodies> held_against_;
};

}  // namespace tactus::rendering
