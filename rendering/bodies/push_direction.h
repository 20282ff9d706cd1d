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

// The two solids of a contact while impulses go between them. It changes copies of their
// velocities, which finish() gives back.
class MeetingSolids {
 public:
  // `pushes_a` is false if A is an obstacle, which cannot be pushed.
  MeetingSolids(bool pushes_a, const SolverBody& a, const SolverBody& b)
      : pushes_a_(pushes_a), a_(a.velocity()), b_(b.velocity()) {}

  // Returns the speed with which the surfaces part along a direction.
  [[nodiscard]] double parting(const PushDirection& along) const {
    return a_.dot(along.on_a) + b_.dot(along.on_b);
  }

  // Applies an impulse along a direction.
  void push_apart(const PushDirection& along, double impulse) {
    if (pushes_a_) {
      a_.gain(impulse, along.answer_a);
    }
    b_.gain(impulse, along.answer_b);
  }

  // Gives the solids the velocities that they have now.
  void finish(SolverBody& a, SolverBody& b) const {
    if (pushes_a_) {
      a.set_velocity(a_.value());
    }
    b.set_velocity(b_.value());
  }

 private:
  bool pushes_a_;
  PairedVec6 a_;
  PairedVec6 b_;
};

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
