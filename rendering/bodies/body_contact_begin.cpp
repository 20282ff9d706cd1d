// The beginning of a contact in a tick: its axes, points and directions, and the impulses that go
// on from the last tick. body_contact.cpp solves it.
#include <algorithm>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/turn_friction.h"

namespace tactus::rendering {
namespace {

// The contact of a body that springs hold is more than so many times as stiff as they are, so that
// the hand feels the springs. It is no stiffer than that beside the stiffness of a free contact,
// which its bodies' mass gives: what the points yield shares the load among them.
constexpr double kStifferThanSprings = 250.0;

// Computes the answers and the masses of a point's directions by the bodies as they are now.
void set_masses(const ContactAxes& axes_W, const SolverBody& a, const SolverBody& b,
                SolvedPoint& point) {
  const double mobility = a.inverse_mass() + b.inverse_mass();
  for (std::size_t k = 0; k < 3; ++k) {
    PushDirection& along = point.along[k];
    set_answers(axes_W, axes_W[k], a, b, along);
    set_mass(is_held(a, b) ? along.shift[static_cast<Eigen::Index>(k)] : mobility, along);
  }
}

// Computes the directions of a point.
void set_directions(const ContactAxes& axes_W, const SolverBody& a, const SolverBody& b,
                    SolvedPoint& point) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& axis = axes_W[k];
    point.along[k].torques = spatial(point.arm_b_W.cross(axis), axis.cross(point.arm_a_W));
  }
  set_masses(axes_W, a, b, point);
}

// Returns the mass that a direction would push if no springs held the bodies; one can move.
double free_mass(const PushDirection& direction, const SolverBody& a, const SolverBody& b) {
  const auto torque_b = direction.torques.head<3>();
  const auto torque_a = direction.torques.tail<3>();
  const double mobility = a.inverse_mass() + b.inverse_mass() +
                          torque_b.dot(b.inverse_inertia_W() * torque_b) +
                          torque_a.dot(a.inverse_inertia_W() * torque_a);
  return 1.0 / mobility;
}

// Returns the share of a free contact's yielding that is left; all of it without springs. The
// stiffness of a contact in a sub-step is in proportion to the mass that it pushes. Springs add
// theirs to that mass, and the contact needs it kStifferThanSprings times.
double yielding_of(const PushDirection& normal, const SolverBody& a, const SolverBody& b) {
  const double of_springs = std::max(a.stiff_share(), b.stiff_share()) *
                            std::max(normal.mass - free_mass(normal, a, b), 0.0);
  return normal.mass / (normal.mass + kStifferThanSprings * of_springs);
}

// Gives a point the impulses of the nearest point of the last tick, seen from B, if that is near.
void take_over_impulses(const PastContact& before, const BodyContact& contact, SolvedPoint& point) {
  constexpr double kNear_m = 2e-3;
  double least = kNear_m * kNear_m;
  for (const PastPoint& old : std::span(before.points).first(before.count)) {
    const double distance2 = (old.arm_b_W - point.arm_b_W).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      const Vec3 rub = old.rub[0] * before.axes_W[1] + old.rub[1] * before.axes_W[2];
      point.push = old.push;
      point.rub = {rub.dot(contact.axes_W[1]), rub.dot(contact.axes_W[2])};
    }
  }
}

}  // namespace

void follow_springs(std::span<const SolverBody> bodies, BodyContact& contact) {
  const SolverBody& a = bodies[contact.a];
  const SolverBody& b = bodies[contact.b];
  for (SolvedPoint& point : std::span(contact.points).first(contact.count)) {
    set_masses(contact.axes_W, a, b, point);
    point.yielding = yielding_of(point.along[0], a, b);
  }
  if (contact.surface.resists_turning()) {
    follow_springs_turning(a, b, contact);
  }
}

PastContact past_of(const BodyContact& contact) {
  PastContact past{.a = contact.a,
                   .b = contact.b,
                   .axes_W = contact.axes_W,
                   .count = contact.count,
                   .torque = contact.torque};
  for (std::size_t i = 0; i < contact.count; ++i) {
    const SolvedPoint& point = contact.points[i];
    past.points[i] = {.arm_b_W = point.arm_b_W, .push = point.push, .rub = point.rub};
  }
  return past;
}

void begin_contact(const Manifold& manifold, std::span<const SolverBody> bodies,
                   const PastContact* before, BodyContact& contact) {
  const SolverBody& a = bodies[contact.a];
  const SolverBody& b = bodies[contact.b];
  const Vec3& normal = manifold.normal_W;
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  contact.axes_W[0] = normal;
  contact.axes_W[1] = normal.cross(Vec3::Unit(least)).normalized();
  contact.axes_W[2] = normal.cross(contact.axes_W[1]);
  contact.pushes_a = a.can_move();
  const MeetingSolids<false> solids(contact.axes_W, a, b);
  contact.count = manifold.count;
  contact.hits = false;
  for (std::size_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& found = manifold.points[i];
    SolvedPoint& point = contact.points[i];
    point.arm_a_W = found.point_W - a.center_W();
    point.arm_b_W = found.point_W - b.center_W();
    point.separation_m = found.separation_m;
    point.separation_now_m = found.separation_m;
    point.push = 0.0;
    point.rub.setZero();
    point.hardest_push = 0.0;
    set_directions(contact.axes_W, a, b, point);
    point.parting_m_per_s = solids.parting(point.along[0]);
    contact.hits = contact.hits || point.is_hit();
    if (before != nullptr) {
      take_over_impulses(*before, contact, point);
    }
  }
  if (contact.surface.resists_turning()) {
    begin_turning(before, a, b, contact);
  }
}

}  // namespace tactus::rendering
