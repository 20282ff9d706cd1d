#include "rendering/bodies/body_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::rendering {
namespace {

// The fastest recovery from an overlap, m/s.
constexpr double kFastestRecovery_m_per_s = 1.0;
// Slower approaches do not bounce, m/s: one of them is gravity's of a few ticks.
constexpr double kLeastBounce_m_per_s = 0.05;

// Returns the speed with which the surfaces part at a point, as a vector; world frame.
Vec3 parting(const SolverBody& a, const SolverBody& b, const SolvedPoint& point) {
  return b.velocity_at(point.arm_b_W) - a.velocity_at(point.arm_a_W);
}

void push_apart(SolverBody& a, SolverBody& b, const SolvedPoint& point, const Vec3& impulse_W) {
  a.push(-impulse_W, point.arm_a_W);
  b.push(impulse_W, point.arm_b_W);
}

double inverse_or_zero(double x) {
  return x > 0.0 ? 1.0 / x : 0.0;
}

// Returns the distance of the surfaces at a point now, m.
double separation_now(const BodyContact& contact, const SolvedPoint& point,
                      std::span<const Shift> shifts) {
  const Shift& a = shifts[contact.a];
  const Shift& b = shifts[contact.b];
  const Vec3 moved_a = a.translation_W + a.rotation * point.arm_a_W - point.arm_a_W;
  const Vec3 moved_b = b.translation_W + b.rotation * point.arm_b_W - point.arm_b_W;
  return point.separation_m + (moved_b - moved_a).dot(contact.normal_W);
}

// Gives a point the impulses of the nearest point of the last tick, seen from B, if that is near.
void take_over_impulses(const BodyContact& before, const BodyContact& contact, SolvedPoint& point) {
  constexpr double kNear_m = 2e-3;
  double least = kNear_m * kNear_m;
  for (const SolvedPoint& old : std::span(before.points).first(before.count)) {
    const double distance2 = (old.arm_b_W - point.arm_b_W).squaredNorm();
    if (distance2 < least) {
      least = distance2;
      const Vec3 rub = old.rub[0] * before.tangents_W[0] + old.rub[1] * before.tangents_W[1];
      point.push = old.push;
      point.rub = {rub.dot(contact.tangents_W[0]), rub.dot(contact.tangents_W[1])};
    }
  }
}

// Friction holds a point within the circle that its push allows.
void solve_friction(BodyContact& contact, SolvedPoint& point, SolverBody& a, SolverBody& b) {
  const Vec3 slip = parting(a, b, point);
  const Eigen::Vector2d along{slip.dot(contact.tangents_W[0]), slip.dot(contact.tangents_W[1])};
  Eigen::Vector2d wanted = point.rub - point.tangent_mass.cwiseProduct(along);
  const double most = contact.surface.friction * point.push;
  const double size = wanted.norm();
  if (size > most) {
    wanted *= most / size;
  }
  const Eigen::Vector2d change = wanted - point.rub;
  point.rub = wanted;
  push_apart(a, b, point, change[0] * contact.tangents_W[0] + change[1] * contact.tangents_W[1]);
}

}  // namespace

ContactSoftness contact_softness(double frequency_Hz, double damping_ratio, double step_s) {
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const double a1 = 2.0 * damping_ratio + step_s * omega;
  const double a2 = step_s * omega * a1;
  return {
      .bias_rate = omega / a1, .mass_scale = a2 / (1.0 + a2), .impulse_scale = 1.0 / (1.0 + a2)};
}

void begin_contact(const Manifold& manifold, std::span<const SolverBody> bodies,
                   const BodyContact* before, BodyContact& contact) {
  const SolverBody& a = bodies[contact.a];
  const SolverBody& b = bodies[contact.b];
  const Vec3& normal = manifold.normal_W;
  contact.normal_W = normal;
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  contact.tangents_W[0] = normal.cross(Vec3::Unit(least)).normalized();
  contact.tangents_W[1] = normal.cross(contact.tangents_W[0]);
  contact.count = manifold.count;
  for (std::size_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& found = manifold.points[i];
    SolvedPoint point{.arm_a_W = found.point_W - a.center_W(),
                      .arm_b_W = found.point_W - b.center_W(),
                      .separation_m = found.separation_m};
    point.parting_m_per_s = parting(a, b, point).dot(normal);
    const auto mass_along = [&](const Vec3& direction) {
      return inverse_or_zero(a.mobility(point.arm_a_W, direction) +
                             b.mobility(point.arm_b_W, direction));
    };
    point.normal_mass = mass_along(normal);
    point.tangent_mass = {mass_along(contact.tangents_W[0]), mass_along(contact.tangents_W[1])};
    if (before != nullptr) {
      take_over_impulses(*before, contact, point);
    }
    contact.points[i] = point;
  }
}

void warm_start(const BodyContact& contact, std::span<SolverBody> bodies) {
  for (std::size_t i = 0; i < contact.count; ++i) {
    const SolvedPoint& point = contact.points[i];
    push_apart(bodies[contact.a], bodies[contact.b], point,
               point.push * contact.normal_W + point.rub[0] * contact.tangents_W[0] +
                   point.rub[1] * contact.tangents_W[1]);
  }
}

void solve_contact(BodyContact& contact, std::span<SolverBody> bodies,
                   std::span<const Shift> shifts, double step_s, const ContactSoftness* softness) {
  SolverBody& a = bodies[contact.a];
  SolverBody& b = bodies[contact.b];
  for (std::size_t i = 0; i < contact.count; ++i) {
    SolvedPoint& point = contact.points[i];
    const double separation = separation_now(contact, point, shifts);
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
    }
    const double approach = parting(a, b, point).dot(contact.normal_W);
    const double change =
        -point.normal_mass * mass_scale * (approach + bias) - impulse_scale * point.push;
    const double push = std::max(point.push + change, 0.0);
    push_apart(a, b, point, (push - point.push) * contact.normal_W);
    point.push = push;
    point.hardest_push = std::max(point.hardest_push, push);
  }
  for (std::size_t i = 0; i < contact.count; ++i) {
    solve_friction(contact, contact.points[i], a, b);
  }
}

void apply_restitution(BodyContact& contact, std::span<SolverBody> bodies) {
  if (!(contact.surface.restitution > 0.0)) {
    return;
  }
  SolverBody& a = bodies[contact.a];
  SolverBody& b = bodies[contact.b];
  for (std::size_t i = 0; i < contact.count; ++i) {
    SolvedPoint& point = contact.points[i];
    if (point.parting_m_per_s > -kLeastBounce_m_per_s || !(point.hardest_push > 0.0)) {
      continue;
    }
    const double approach = parting(a, b, point).dot(contact.normal_W);
    const double change =
        -point.normal_mass * (approach + contact.surface.restitution * point.parting_m_per_s);
    const double push = std::max(point.push + change, 0.0);
    push_apart(a, b, point, (push - point.push) * contact.normal_W);
    point.push = push;
  }
}

}  // namespace tactus::rendering
