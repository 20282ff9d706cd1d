// Two solids that push and turn each other at a contact. The solver keeps their velocities as both
// angular velocities, and as the velocity of B less that of A along the contact's three axes, along
// which impulses act, too.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/bodies/solver_body.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The normal of a contact from A to B and two tangents, unit, world frame.
using ContactAxes = std::array<Vec3, 3>;

// An axis of a contact along which an impulse acts at a point, or about which a torque acts. The
// impulse acts on B, and the opposite one on A.
struct PushDirection {
  // The mass that it pushes, kg, or the inertia that it turns, kg m^2.
  double mass = 0.0;
  // The torques on B and on A about their centres by an impulse of 1 N s, or by one of 1 N m s.
  // Their product with the angular velocities is the part of the speed that turning makes.
  Vec6 torques = Vec6::Zero();
  // The changes of the angular velocities of B and of A by such an impulse.
  Vec6 turns = Vec6::Zero();
  // The change of B's velocity less A's along the axes by such an impulse. It is set only where
  // springs hold one of the solids; a free body is shifted along the impulse, and by no torque.
  Vec3 shift = Vec3::Zero();
};

// The two solids of a contact while impulses go between them. It changes copies of their
// velocities, which finish() gives back. `kHeld` is true if springs hold one of the solids.
template <bool kHeld>
class MeetingSolids {
 public:
  // This and finish() are inlined, and without Eigen's expressions, which are not: the solver
  // begins and ends so for every contact in every pass, and keeps the numbers in registers in
  // between.
  [[gnu::always_inline]] MeetingSolids(const ContactAxes& axes_W, const SolverBody& a,
                                       const SolverBody& b)
      : axes_W_(&axes_W),
        mobility_(a.inverse_mass() + b.inverse_mass()),
        angular_(b.velocity().data() + 3, a.velocity().data() + 3),
        torques_(Vec6::Zero()) {
    const double x = b.velocity()[0] - a.velocity()[0];
    const double y = b.velocity()[1] - a.velocity()[1];
    const double z = b.velocity()[2] - a.velocity()[2];
    const auto along = [&](const Vec3& n) { return x * n.x() + y * n.y() + z * n.z(); };
    parting_ = along(axes_W[0]);
    slip_ = Pair{along(axes_W[1]), along(axes_W[2])};
  }

  // Returns the speed with which the surfaces part along the normal, m/s.
  [[nodiscard]] double parting(const PushDirection& normal) const {
    return parting_ + angular_.dot(normal.torques);
  }
  // Returns `impulse` less `mass` times that speed. The part of the linear velocity is taken first:
  // it is known earlier than the other, and each contact waits for the one before.
  [[nodiscard]] double less_parting(double impulse, double mass,
                                    const PushDirection& normal) const {
    return (impulse - mass * parting_) - mass * angular_.dot(normal.torques);
  }
  // Returns the impulses along the two tangents that stop the slip there, each with its mass.
  [[nodiscard]] Pair against_slip(Pair masses, const PushDirection& first,
                                  const PushDirection& second) const {
    return -masses * slip_ - masses * angular_.dots(first.torques, second.torques);
  }
  // Returns the speed with which B turns about an axis against A, rad/s.
  [[nodiscard]] double turning(const PushDirection& about) const {
    return angular_.dot(about.torques);
  }

  // Applies an impulse along the normal, N s.
  void push_apart(const PushDirection& normal, double impulse) {
    push_ += impulse;
    if constexpr (!kHeld) {
      parting_ += impulse * mobility_;
    }
    turn(normal, impulse);
  }
  // Applies impulses along the two tangents, N s.
  void rub(const PushDirection& first, const PushDirection& second, Pair impulses) {
    rub_ += impulses;
    if constexpr (!kHeld) {
      slip_ += impulses * both(mobility_);
    }
    angular_.gain(impulses[0], first.turns, impulses[1], second.turns);
    if constexpr (kHeld) {
      torques_.gain(impulses[0], first.torques, impulses[1], second.torques);
      shift(impulses[0], first);
      shift(impulses[1], second);
    }
  }
  // Applies an impulse about an axis, N m s.
  void turn(const PushDirection& about, double impulse) {
    angular_.gain(impulse, about.turns);
    if constexpr (kHeld) {
      torques_.gain(impulse, about.torques);
      shift(impulse, about);
    }
  }

  // Gives the solids the velocities that they have now.
  [[gnu::always_inline]] void finish(SolverBody& a, SolverBody& b) const {
    const auto& [normal, first, second] = *axes_W_;
    const Vec3 impulse_W(push_ * normal.x() + rub_[0] * first.x() + rub_[1] * second.x(),
                         push_ * normal.y() + rub_[0] * first.y() + rub_[1] * second.y(),
                         push_ * normal.z() + rub_[0] * first.z() + rub_[1] * second.z());
    if constexpr (kHeld) {
      b.accelerate(spatial(impulse_W, torques_.head()));
      a.accelerate(spatial(-impulse_W, torques_.tail()));
    } else {
      b.push_to(1.0, impulse_W, angular_.head());
      a.push_to(-1.0, impulse_W, angular_.tail());
    }
  }

 private:
  void shift(double impulse, const PushDirection& direction) {
    parting_ += impulse * direction.shift[0];
    slip_ += both(impulse) * pair_at(direction.shift.data() + 1);
  }

  const ContactAxes* axes_W_;
  // The change of the linear velocity by an impulse of 1 N s, where no springs hold.
  double mobility_;
  // The linear velocity of B less that of A, along the normal and the tangents.
  double parting_ = 0.0;
  Pair slip_{};
  // The angular velocities of B and A.
  PairedVec6 angular_;
  // The impulses along the normal and the tangents so far, and the torques on B and A where springs
  // hold.
  double push_ = 0.0;
  Pair rub_{};
  PairedVec6 torques_;
};

// Returns true if springs hold one of the solids.
inline bool is_held(const SolverBody& a, const SolverBody& b) {
  return a.has_springs() || b.has_springs();
}

// Computes the answers of the solids as they are now to an impulse `push_W`, a unit vector, with
// the direction's torques; zero of a direction about an axis.
inline void set_answers(const ContactAxes& axes_W, const Vec3& push_W, const SolverBody& a,
                        const SolverBody& b, PushDirection& direction) {
  const auto torque_b = direction.torques.head<3>();
  const auto torque_a = direction.torques.tail<3>();
  if (!is_held(a, b)) {
    direction.turns.head<3>() = b.inverse_inertia_W() * torque_b;
    direction.turns.tail<3>() = a.inverse_inertia_W() * torque_a;
    return;
  }
  const Vec6 answer_b = b.answer_to(spatial(push_W, torque_b));
  const Vec6 answer_a = a.answer_to(spatial(-push_W, torque_a));
  direction.turns.head<3>() = answer_b.tail<3>();
  direction.turns.tail<3>() = answer_a.tail<3>();
  const Vec3 apart_W = answer_b.head<3>() - answer_a.head<3>();
  direction.shift = {apart_W.dot(axes_W[0]), apart_W.dot(axes_W[1]), apart_W.dot(axes_W[2])};
}

// Computes the mass of a direction from the answers. `shift` is how far the impulse of 1 N s shifts
// the solids apart along itself, m/s; 0 about an axis.
inline void set_mass(double shift, PushDirection& direction) {
  const double mobility = shift + dot(direction.torques, direction.turns);
  direction.mass = mobility > 0.0 ? 1.0 / mobility : 0.0;
}

}  // namespace tactus::rendering
