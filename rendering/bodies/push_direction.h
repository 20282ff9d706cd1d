// A direction along which two solids push each other, or an axis about which they turn each other,
// with all that the solver needs of it.
#pragma once

#include "rendering/bodies/solver_body.h"

namespace tactus::rendering {

struct PushDirection {
  // The impulses of 1 N s on A and B with their torques, or those of 1 N m s. Their products with
  // the velocities add up to the speed with which the surfaces part, or turn.
  Vec6 on_a = Vec6::Zero();
  Vec6 on_b = Vec6::Zero();
  // The changes of the velocities of A and B by these impulses.
  Vec6 answer_a = Vec6::Zero();
  Vec6 answer_b = Vec6::Zero();
  // The mass that it pushes, kg, or the inertia that it turns, kg m^2.
  double mass = 0.0;
};

// Returns the speed with which the surfaces part along a direction.
inline double parting(const SolverBody& a, const SolverBody& b, const PushDirection& along) {
  return dot(along.on_a, a.velocity()) + dot(along.on_b, b.velocity());
}

// Applies an impulse; A may be an obstacle, which cannot be pushed.
inline void push_apart(bool pushes_a, SolverBody& a, SolverBody& b, const PushDirection& along,
                       double impulse) {
  if (pushes_a) {
    a.gain(impulse, along.answer_a);
  }
  b.gain(impulse, along.answer_b);
}

// Computes the answers of the bodies as they are now.
inline void set_answers(bool pushes_a, const SolverBody& a, const SolverBody& b,
                        PushDirection& along) {
  if (pushes_a) {
    along.answer_a = a.answer_to(along.on_a);
  }
  along.answer_b = b.answer_to(along.on_b);
}

// Computes the mass of a direction from the answers.
inline void set_mass(bool pushes_a, PushDirection& along) {
  const double mobility =
      (pushes_a ? dot(along.on_a, along.answer_a) : 0.0) + dot(along.on_b, along.answer_b);
  along.mass = mobility > 0.0 ? 1.0 / mobility : 0.0;
}

}  // namespace tactus::rendering
