#include "rendering/bodies/body_world.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// The sub-steps of a tick.
constexpr int kSubSteps = 4;
// Each pass of a sub-step solves all contacts so often.
constexpr int kPasses = 2;
// The frequency of the spring that undoes overlaps is this share of the sub-steps' rate, and it is
// damped far beyond its critical damping.
constexpr double kContactShare = 0.25;
constexpr double kContactDamping = 10.0;
// Surfaces nearer than this, and what their motion in a tick may close, are looked at, m.
constexpr double kMargin_m = 5e-4;
// A contact goes on from tick to tick while its normal turns by less than the arccosine of this.
constexpr double kSameContact = 0.5;

// Returns the friction and the restitution of two surfaces: the geometric mean of the coefficients,
// and the larger of the other numbers.
ContactSurface surface_of(const ContactSurface& a, const ContactSurface& b) {
  return {.friction = std::sqrt(a.friction * b.friction),
          .restitution = std::max(a.restitution, b.restitution),
          .rolling_m = std::max(a.rolling_m, b.rolling_m),
          .spinning_m = std::max(a.spinning_m, b.spinning_m)};
}

// Returns the largest speed of a point of a solid.
double fastest(const SolverBody& solid, const PlacedHull& hull) {
  const double reach = (hull.middle_W() - solid.center_W()).norm() + hull.reach_m();
  return solid.velocity().head<3>().norm() + reach * solid.velocity().tail<3>().norm();
}

// Returns the largest speed of a point that a solid carries along, within a hull's reach.
double fastest_at(const SolverBody& solid, const PlacedHull& hull) {
  return solid.velocity_at(hull.middle_W() - solid.center_W()).norm() +
         hull.reach_m() * solid.velocity().tail<3>().norm();
}

// Returns the pose of a frame, seen from another one.
RigidPose seen_from(const RigidPose& X_WO, const RigidPose& X_WB) {
  return {.rotation = X_WO.rotation.transpose() * X_WB.rotation,
          .translation = X_WO.point_in(X_WB.translation)};
}

bool is_hull(const ConvexHull& hull) {
  return !hull.vertices_O.empty() && hull.vertices_O.size() <= kMaxHullVertices;
}

}  // namespace

void BodyWorld::clear() {
  body_count_ = 0;
  obstacle_count_ = 0;
  gravity_W_ = Vec3::Zero();
  contact_count_ = 0;
  left_out_ = false;
  grips_.clear(0.0);
}

bool BodyWorld::add_body(const BodyStart& start) {
  if (body_count_ == kMaxBodies || !valid(start.body.mass) || !is_hull(start.body.hull)) {
    return false;
  }
  bodies_[body_count_] =
      RigidBody(start.body.mass, start.X_WO, start.body.velocity_W, start.body.angular_velocity_O);
  starts_[body_count_++] = start;
  return true;
}

bool BodyWorld::add_obstacle(const BodyObstacle& obstacle) {
  const bool is_good = obstacle.hull.vertices_O.empty() || is_hull(obstacle.hull);
  if (obstacle_count_ == kMaxObstacles || !is_good) {
    return false;
  }
  obstacles_[obstacle_count_++] = obstacle;
  return true;
}

void BodyWorld::set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist) {
  obstacles_[obstacle].X_WO = X_WO;
  obstacles_[obstacle].twist = twist;
}

void BodyWorld::step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W) {
  for (std::size_t i = 0; i < body_count_; ++i) {
    solids_[i].take(bodies_[i]);
    shifts_[i] = {};
  }
  for (std::size_t i = 0; i < obstacle_count_; ++i) {
    solids_[body_count_ + i].take_obstacle(obstacles_[i].X_WO.translation, obstacles_[i].twist);
    shifts_[body_count_ + i] = {};
  }
  const double step_s = tick_s / kSubSteps;
  grips_.begin_tick(grips, bodies());
  grips_.begin_step(solids_, step_s);
  find_contacts(tick_s);
  for (int i = 0; i < kSubSteps; ++i) {
    sub_step(step_s, i + 1 == kSubSteps);
  }
  for (std::size_t i = 0; i < forces_W.size(); ++i) {
    forces_W[i] = grips_.force_on_hand(i, tick_s);
  }
}

std::size_t BodyWorld::point_count() const {
  std::size_t count = 0;
  for (const BodyContact& contact : std::span(contacts_).first(contact_count_)) {
    count += contact.count;
  }
  return count;
}

void BodyWorld::find_contacts(double tick_s) {
  std::transform(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(contact_count_),
                 contacts_before_.begin(), past_of);
  contact_count_before_ = contact_count_;
  contact_count_ = 0;
  left_out_ = false;
  const auto solid_count = static_cast<std::uint16_t>(body_count_ + obstacle_count_);
  std::array<double, kMostSolids> margins{};
  for (std::uint16_t i = 0; i < solid_count; ++i) {
    const bool is_body = i < body_count_;
    const ConvexHull& hull = is_body ? starts_[i].body.hull : obstacles_[i - body_count_].hull;
    if (!hull.vertices_O.empty()) {
      hulls_[i].place(hull, is_body ? bodies_[i].pose() : obstacles_[i - body_count_].X_WO);
      margins[i] = tick_s * fastest(solids_[i], hulls_[i]);
    }
  }
  const auto body_count = static_cast<std::uint16_t>(body_count_);
  for (std::uint16_t b = 0; b < body_count; ++b) {
    for (std::uint16_t a = 0; a < solid_count; ++a) {
      if (a < b || a >= body_count_) {
        const bool has_hull =
            a < body_count_ || !obstacles_[a - body_count_].hull.vertices_O.empty();
        const double speed = has_hull ? 0.0 : fastest_at(solids_[a], hulls_[b]);
        find_contacts_with(a, b, kMargin_m + margins[a] + margins[b] + tick_s * speed);
      }
    }
  }
}

void BodyWorld::find_contacts_with(std::uint16_t a, std::uint16_t b, double margin_m) {
  if (a < body_count_) {
    add_contact(a, b, manifold_of(hulls_[a], hulls_[b], margin_m));
    return;
  }
  const BodyObstacle& obstacle = obstacles_[a - body_count_];
  const RigidPose& X_WO = obstacle.X_WO;
  const bool is_mesh = !obstacle.mesh.triangles.empty();
  if (is_mesh || obstacle.field.is_there()) {
    seen_.place(starts_[b].body.hull, seen_from(X_WO, bodies_[b].pose()));
    const auto manifolds = is_mesh
                               ? mesh_contact_.find(obstacle.mesh, obstacle.sides, seen_, margin_m)
                               : field_contact_.find(obstacle.field, seen_, margin_m);
    for (const Manifold& manifold : manifolds) {
      add_contact(a, b, manifold, X_WO);
    }
    left_out_ = left_out_ || (is_mesh && mesh_contact_.has_left_out());
  } else if (obstacle.hull.vertices_O.empty()) {
    add_contact(a, b,
                manifold_of(X_WO.point(obstacle.plane_O.translation),
                            X_WO.direction(obstacle.plane_O.rotation.col(1)), hulls_[b], margin_m));
  } else {
    add_contact(a, b, manifold_of(hulls_[a], hulls_[b], margin_m));
  }
}

void BodyWorld::add_contact(std::uint16_t a, std::uint16_t b, Manifold manifold,
                            const RigidPose& X_WO) {
  manifold.normal_W = X_WO.direction(manifold.normal_W);
  for (ManifoldPoint& point : std::span(manifold.points).first(manifold.count)) {
    point.point_W = X_WO.point(point.point_W);
  }
  add_contact(a, b, manifold);
}

void BodyWorld::add_contact(std::uint16_t a, std::uint16_t b, const Manifold& manifold) {
  if (manifold.count == 0) {
    return;
  }
  if (contact_count_ == kMaxBodyContacts) {
    left_out_ = true;
    return;
  }
  // The same contact in the last tick: of several the one with the most similar normal.
  const PastContact* before = nullptr;
  double likeness = kSameContact;
  for (const PastContact& old : std::span(contacts_before_).first(contact_count_before_)) {
    if (old.a == a && old.b == b && old.axes_W[0].dot(manifold.normal_W) > likeness) {
      before = &old;
      likeness = old.axes_W[0].dot(manifold.normal_W);
    }
  }
  const ContactSurface& of_a =
      a < body_count_ ? starts_[a].surface : obstacles_[a - body_count_].surface;
  BodyContact& contact = contacts_[contact_count_++];
  contact.a = a;
  contact.b = b;
  contact.surface = surface_of(of_a, starts_[b].surface);
  begin_contact(manifold, solids_, before, contact);
}

void BodyWorld::sub_step(double step_s, bool is_last) {
  const auto contacts = std::span(contacts_).first(contact_count_);
  const ContactSoftness softness =
      contact_softness(kContactShare / step_s, kContactDamping, step_s);
  for (std::size_t i = 0; i < body_count_; ++i) {
    bodies_[i].accelerate(gravity_W_, step_s);
    solids_[i].begin(bodies_[i]);
  }
  grips_.begin_step(solids_, step_s);
  grips_.begin_spins(solids_);
  for (BodyContact& contact : contacts) {
    warm_start(contact, solids_);
  }
  solve_contacts(step_s, &softness);
  sum_impulses();
  move_bodies(step_s);
  for (BodyContact& contact : contacts) {
    follow_motion(contact, shifts_);
  }
  solve_contacts(step_s, nullptr);
  if (is_last) {
    for (BodyContact& contact : contacts) {
      apply_restitution(contact, solids_);
    }
  }
  sum_impulses();
  for (std::uint32_t i = 0; i < body_count_; ++i) {
    const Vec6 impulse = pushed_[i] + grips_.impulse_on(i, solids_);
    bodies_[i].push(impulse.head<3>(), impulse.tail<3>());
  }
  grips_.end_step(moved_);
}

void BodyWorld::solve_contacts(double step_s, const ContactSoftness* softness) {
  for (int pass = 0; pass < kPasses; ++pass) {
    grips_.solve_spins(solids_);
    for (BodyContact& contact : std::span(contacts_).first(contact_count_)) {
      solve_contact(contact, solids_, step_s, softness);
    }
  }
}

// The velocities of a body that no springs hold have changed by the contacts' impulses alone.
void BodyWorld::sum_impulses() {
  bool any_springs = false;
  for (std::size_t i = 0; i < body_count_; ++i) {
    any_springs = any_springs || solids_[i].has_springs();
    pushed_[i].setZero();
  }
  for (std::size_t i = 0; any_springs && i < contact_count_; ++i) {
    add_impulses(contacts_[i], pushed_);
  }
  grips_.add_spins(pushed_);
  for (std::size_t i = 0; i < body_count_; ++i) {
    if (!solids_[i].has_springs()) {
      pushed_[i] =
          solids_[i].impulse_since(bodies_[i].motion().velocity_W, bodies_[i].angular_velocity_W());
    }
  }
}

// The bodies' own velocities change only at the end of the sub-step: here a copy moves.
void BodyWorld::move_bodies(double step_s) {
  for (std::uint32_t i = 0; i < body_count_; ++i) {
    RigidBody moving = bodies_[i];
    const Vec6 impulse = pushed_[i] + grips_.impulse_on(i, solids_);
    moving.push(impulse.head<3>(), impulse.tail<3>());
    moved_[i] << moving.motion().velocity_W, moving.angular_velocity_W();
    const Mat3 before = bodies_[i].motion().rotation_WO;
    moving.move(step_s);
    const BodyMotion& now = moving.motion();
    shifts_[i].translation_W += now.center_W - bodies_[i].motion().center_W;
    shifts_[i].rotation = now.rotation_WO * before.transpose() * shifts_[i].rotation;
    bodies_[i].set_place(now.center_W, now.rotation_WO);
  }
  for (std::size_t i = 0; i < obstacle_count_; ++i) {
    Shift& shift = shifts_[body_count_ + i];
    const Twist& twist = obstacles_[i].twist;
    shift.translation_W += step_s * twist.linear_W;
    shift.rotation = rotation_by(step_s * twist.angular_W) * shift.rotation;
  }
}

}  // namespace tactus::rendering
