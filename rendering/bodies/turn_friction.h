// The resistance of a contact to rolling and to spinning about its normal: the solids do not turn
// against each other, with torques that are at most a length times the normal force of the
// contact's points. About the tangents both torques together are within a circle. The header is for
// body_contact.cpp.
//
// A solid ball of radius r that rolls without slipping is slowed down by 5/7 g c / r with c the
// length, and stops: the friction that keeps it from slipping turns it on.
#pragma once

#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/solver_body.h"

namespace tactus::rendering {

// Begins the resistance in a tick, with the torques of `before` unless that is nullptr.
void begin_turning(const PastContact* before, const SolverBody& a, const SolverBody& b,
                   BodyContact& contact);

// Computes the answers of bodies that springs hold as they are now.
void follow_springs_turning(const SolverBody& a, const SolverBody& b, BodyContact& contact);

// Begins a sub-step: applies the torques that the last one ended with.
template <bool kHeld>
void warm_start_turning(BodyContact& contact, MeetingSolids<kHeld>& solids);

// Stops the turning once, within the limits of the present push.
template <bool kHeld>
void solve_turning(BodyContact& contact, MeetingSolids<kHeld>& solids);

// Returns the torque on B, N m s; the opposite one acts on A.
Vec3 turning_torque_W(const BodyContact& contact);

}  // namespace tactus::rendering
