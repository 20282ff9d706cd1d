#include "rendering/bodies/body_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/bodies/turn_friction.h"

namespace tactus::rendering {
namespace {

// The fastest recovery from an overlap, m/s.
constexpr double kFastestRecovery_m_per_s = 1.0;
// The points of a contact that hits are solved so often in a pass: their impulses begin anew, and
// those of one side alone would turn the body about the other side. So are those of a body that
// springs hold: a light one is held by forces that are far larger than its weight.
constexpr int kRoundsOfLoad = 8;
// Bounces are solved until their impulses change by less than this share.
constexpr double kLeastChange = 1e-3;

// Friction holds a point within the circle that its push allows. The impulse that would stop the
// slip in both directions is of no use to a point that slips: where the masses along them differ it
// is not against the slip. A step of one mass for both leads there.
template <bool kHeld>
[[gnu::always_inline]] inline void solve_friction(double friction, SolvedPoint& point,
                                                  MeetingSolids<kHeld>& solids) {
  const auto& [normal, first, second] = point.along;
  const double most2 = (friction * point.push) * (friction * point.push);
  const Pair before = pair_at(point.rub.data());
  Pair change = solids.against_slip(Pair{first.mass, second.mass}, first, second);
  if (squared_norm(before + change) > most2) {
    change = solids.against_slip(both(std::min(first.mass, second.mass)), first, second);
    const double size2 = squared_norm(before + change);
    if (size2 > most2) {
      change = both(std::sqrt(most2 / size2)) * (before + change) - before;
    }
  }
  solids.rub(first, second, change);
  const Pair rub = before + change;
  point.rub = {rub[0], rub[1]};
}

// Solves the points along the normal once.
template <bool kHeld>
[[gnu::always_inline]] inline void solve_pushes(BodyContact& contact, MeetingSolids<kHeld>& solids,
                                                double step_s, const ContactSoftness* softness) {
  for (std::size_t i = 0; i < contact.count; ++i) {
    SolvedPoint& point = contact.points[i];
    const double separation = point.separation_now_m;
    double bias = 0.0;
    double mass_scale = 1.0;
    double impulse_scale = 0.0;
    if (separation > 0.0) {
      // Surfaces that are apart may come together in this sub-step, and no more.
      bias = separation / step_s;
    } else if (softness != nullptr) {
      bias = std::max(softness->bias_rate * separation, -kFastestRecovery_m_per_s);
      mass_scale = softness->mass_scale;
      impulse_scale = softness->impulse_scale;
      if constexpr (kHeld) {
        impulse_scale *= point.yielding;
        mass_scale = 1.0 - impulse_scale;
      }
    }
    const double mass = point.along[0].mass * mass_scale;
    const double kept = (1.0 - impulse_scale) * point.push - mass * bias;
    const double push = std::max(solids.less_parting(kept, mass, point.along[0]), 0.0);
    if (push != point.push) {
      solids.push_apart(point.along[0], push - point.push);
      point.push = push;
      point.hardest_push = std::max(point.hardest_push, push);
    }
  }
}

// The parts of warm_start(), solve_contact() and apply_restitution(), for bodies that springs hold,
// or others, and surfaces that resist turning, or others. The velocities stay in registers where
// nothing turns.
template <bool kHeld, bool kTurns>
void warm_start_points(BodyContact& contact, SolverBody& a, SolverBody& b) {
  MeetingSolids<kHeld> solids(contact.axes_W, a, b);
  for (const SolvedPoint& point : std::span(contact.points).first(contact.count)) {
    solids.push_apart(point.along[0], point.push);
    solids.rub(point.along[1], point.along[2], pair_at(point.rub.data()));
  }
  if constexpr (kTurns) {
    warm_start_turning(contact, solids);
  }
  solids.finish(a, b);
}

template <bool kHeld, bool kTurns>
void solve_points(BodyContact& contact, SolverBody& a, SolverBody& b, double step_s,
                  const ContactSoftness* softness) {
  MeetingSolids<kHeld> solids(contact.axes_W, a, b);
  const int rounds = kHeld || contact.hits ? kRoundsOfLoad : 1;
  for (int round = 0; round < rounds; ++round) {
    solve_pushes(contact, solids, step_s, softness);
    if constexpr (kTurns) {
      solve_turning(contact, solids);
    }
    for (SolvedPoint& point : std::span(contact.points).first(contact.count)) {
      // A point that is not pushed has no friction.
      if (point.push > 0.0 || point.rub[0] != 0.0 || point.rub[1] != 0.0) {
        solve_friction(contact.surface.friction, point, solids);
      }
    }
  }
  solids.finish(a, b);
}

// Calls solve<kHeld, kTurns>() for the bodies and the surface of a contact.
template <class Solve>
void for_kind(const BodyContact& contact, const SolverBody& a, const SolverBody& b,
              const Solve& solve) {
  const bool turns = contact.surface.resists_turning();
  if (is_held(a, b)) {
    turns ? solve.template operator()<true, true>() : solve.template operator()<true, false>();
  } else {
    turns ? solve.template operator()<false, true>() : solve.template operator()<false, false>();
  }
}

template <bool kHeld>
bool bounce_points(BodyContact& contact, SolverBody& a, SolverBody& b) {
  MeetingSolids<kHeld> solids(contact.axes_W, a, b);
  bool has_changed = false;
  for (SolvedPoint& point : std::span(contact.points).first(contact.count)) {
    if (!point.is_hit() || !(point.hardest_push > 0.0)) {
      continue;
    }
    const double approach = solids.parting(point.along[0]);
    const double change =
        -point.along[0].mass * (approach + contact.surface.restitution * point.parting_m_per_s);
    const double push = std::max(point.push + change, 0.0);
    has_changed = has_changed || std::abs(push - point.push) > kLeastChange * point.hardest_push;
    solids.push_apart(point.along[0], push - point.push);
    point.push = push;
  }
  solids.finish(a, b);
  return has_changed;
}

}  // namespace

ContactSoftness contact_softness(double frequency_Hz, double damping_ratio, double step_s) {
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const double a1 = 2.0 * damping_ratio + step_s * omega;
  const double a2 = step_s * omega * a1;
  return {
      .bias_rate = omega / a1, .mass_scale = a2 / (1.0 + a2), .impulse_scale = 1.0 / (1.0 + a2)};
}

void warm_start(BodyContact& contact, std::span<SolverBody> bodies) {
  SolverBody& a = bodies[contact.a];
  SolverBody& b = bodies[contact.b];
  for_kind(contact, a, b,
           [&]<bool kHeld, bool kTurns>() { warm_start_points<kHeld, kTurns>(contact, a, b); });
}

// A rotation R moves the point at `arm` along the normal n by (R arm - arm) n = arm (R'n - n).
void follow_motion(BodyContact& contact, std::span<const Shift> shifts) {
  const Shift& a = shifts[contact.a];
  const Shift& b = shifts[contact.b];
  const Vec3& normal = contact.axes_W[0];
  const double shifted = (b.translation_W - a.translation_W).dot(normal);
  const Vec3 turned_a = a.rotation.transpose() * normal - normal;
  const Vec3 turned_b = b.rotation.transpose() * normal - normal;
  for (std::size_t i = 0; i < contact.count; ++i) {
    SolvedPoint& point = contact.points[i];
    point.separation_now_m =
        point.separation_m + shifted + point.arm_b_W.dot(turned_b) - point.arm_a_W.dot(turned_a);
  }
}

void solve_contact(BodyContact& contact, std::span<SolverBody> bodies, double step_s,
                   const ContactSoftness* softness) {
  SolverBody& a = bodies[contact.a];
  SolverBody& b = bodies[contact.b];
  for_kind(contact, a, b, [&]<bool kHeld, bool kTurns>() {
    solve_points<kHeld, kTurns>(contact, a, b, step_s, softness);
  });
}

bool apply_restitution(BodyContact& contact, std::span<SolverBody> bodies) {
  if (!(contact.surface.restitution > 0.0) || !contact.hits) {
    return false;
  }
  SolverBody& a = bodies[contact.a];
  SolverBody& b = bodies[contact.b];
  return is_held(a, b) ? bounce_points<true>(contact, a, b) : bounce_points<false>(contact, a, b);
}

void add_impulses(const BodyContact& contact, std::span<Vec6> wrenches) {
  for (std::size_t i = 0; i < contact.count; ++i) {
    const SolvedPoint& point = contact.points[i];
    const Vec3 impulse = point.push * contact.axes_W[0] + point.rub[0] * contact.axes_W[1] +
                         point.rub[1] * contact.axes_W[2];
    wrenches[contact.b].head<3>() += impulse;
    wrenches[contact.b].tail<3>() += point.arm_b_W.cross(impulse);
    if (contact.pushes_a) {
      wrenches[contact.a].head<3>() -= impulse;
      wrenches[contact.a].tail<3>() -= point.arm_a_W.cross(impulse);
    }
  }
  if (contact.surface.resists_turning()) {
    const Vec3 torque_W = turning_torque_W(contact);
    wrenches[contact.b].tail<3>() += torque_W;
    if (contact.pushes_a) {
      wrenches[contact.a].tail<3>() -= torque_W;
    }
  }
}

}  // namespace tactus::rendering
