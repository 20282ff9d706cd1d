#include "rendering/bodies/body_world.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// The sub-steps of a tick.
constexpr int kSubSteps = 4;
// Each pass of a sub-step solves all contacts so often.
constexpr int kPasses = 2;
// Bounces are solved so often at most.
constexpr int kMostBouncePasses = 16;
// The frequency of the spring that undoes overlaps is this share of the sub-steps' rate, and it is
// damped far beyond its critical damping.
constexpr double kContactShare = 0.25;
constexpr double kContactDamping = 10.0;
bool is_hull(const ConvexHull& hull) {
  return !hull.vertices_O.empty() && hull.vertices_O.size() <= kMaxHullVertices;
}

}  // namespace

void BodyWorld::clear() {
  body_count_ = 0;
  part_count_ = 0;
  obstacle_count_ = 0;
  gravity_W_ = Vec3::Zero();
  contact_count_ = 0;
  left_out_ = false;
  obstacle_moves_.fill(false);
  grips_.clear(0.0);
  sleep_.start(0.0);
}

bool BodyWorld::add_body(const BodyStart& start) {
  const std::span<const ConvexHull> parts = start.parts;
  const bool has_room = body_count_ < kMaxBodies && parts.size() <= kMaxPartsOfBody &&
                        parts.size() <= kMaxBodyParts - part_count_;
  const bool has_shape =
      parts.empty() ? is_hull(start.body.hull) : std::ranges::all_of(parts, is_hull);
  if (!has_room || !has_shape || !valid(start.body.mass)) {
    return false;
  }
  first_part_[body_count_] = static_cast<std::uint16_t>(part_count_);
  part_count_ += parts.size();
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

void BodyWorld::set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist,
                             bool moves) {
  obstacles_[obstacle].X_WO = X_WO;
  obstacles_[obstacle].twist = twist;
  obstacle_moves_[obstacle] = moves;
}

void BodyWorld::take_body(std::size_t body) {
  solids_[body].take(bodies_[body]);
  shifts_[body] = {};
}

void BodyWorld::step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W) {
  for (const FingerGrip& grip : grips) {
    sleep_.wake(grip.body);
  }
  list_awake();
  if (!is_all_asleep()) {
    step_awake(tick_s, grips);
  } else {
    contact_count_ = 0;
    left_out_ = false;
  }
  for (std::size_t i = 0; i < forces_W.size(); ++i) {
    forces_W[i] = grips_.force_on_hand(i, tick_s);
  }
}

void BodyWorld::step_awake(double tick_s, std::span<const FingerGrip> grips) {
  for (const std::uint8_t i : awake()) {
    take_body(i);
  }
  for (std::size_t i = 0; i < obstacle_count_; ++i) {
    solids_[body_count_ + i].take_obstacle(obstacles_[i].X_WO.translation, obstacles_[i].twist);
    shifts_[body_count_ + i] = {};
  }
  const double step_s = tick_s / kSubSteps;
  grips_.begin_tick(grips, bodies(), step_s);
  find_contacts(tick_s);
  for (int i = 0; i < kSubSteps; ++i) {
    sub_step(step_s, i + 1 == kSubSteps);
  }
  rest_bodies(tick_s, grips);
}

std::size_t BodyWorld::point_count() const {
  std::size_t count = 0;
  for (const BodyContact& contact : std::span(contacts_).first(contact_count_)) {
    count += contact.count;
  }
  return count;
}

void BodyWorld::sub_step(double step_s, bool is_last) {
  const auto contacts = std::span(contacts_).first(contact_count_);
  const ContactSoftness softness =
      contact_softness(kContactShare / step_s, kContactDamping, step_s);
  for (const std::uint8_t i : awake()) {
    bodies_[i].accelerate(gravity_W_, step_s);
    solids_[i].begin(bodies_[i]);
  }
  for (BodyContact& contact : contacts) {
    if (is_held(contact)) {
      follow_springs(solids_, contact);
    }
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
    bounce();
  }
  sum_impulses();
  for (const std::uint8_t i : awake()) {
    const Vec6 impulse = pushed_[i] + grips_.impulse_on(i, solids_);
    bodies_[i].push(impulse.head<3>(), impulse.tail<3>());
  }
  grips_.end_step(moved_);
}

// The impulses of contacts decide which fingers let go or slip, and they change in each pass. Where
// they are those of the pass before, as of a body without contacts, the springs are solved already.
void BodyWorld::hold_bodies() {
  if (!grips_.any()) {
    return;
  }
  sum_impulses();
  bool has_changed = false;
  for (const std::uint8_t i : awake()) {
    const bool is_solved = solids_[i].has_springs() && pushed_[i] == held_against_[i];
    if (grips_.holds(i) && !is_solved) {
      solids_[i].begin(bodies_[i]);
      solids_[i].accelerate(pushed_[i]);
      grips_.hold(i, solids_[i]);
      held_against_[i] = pushed_[i];
      has_changed = true;
    }
  }
  if (!has_changed) {
    return;
  }
  for (BodyContact& contact : std::span(contacts_).first(contact_count_)) {
    if (is_held(contact)) {
      follow_springs(solids_, contact);
    }
  }
  grips_.limit_spins(solids_);
}

void BodyWorld::solve_contacts(double step_s, const ContactSoftness* softness) {
  for (int pass = 0; pass < kPasses; ++pass) {
    hold_bodies();
    grips_.solve_spins(solids_);
    for (BodyContact& contact : std::span(contacts_).first(contact_count_)) {
      solve_contact(contact, solids_, step_s, softness);
    }
  }
}

// The bounces of the points of a contact, and of neighbours, depend on each other.
void BodyWorld::bounce() {
  bool goes_on = true;
  for (int pass = 0; goes_on && pass < kMostBouncePasses; ++pass) {
    goes_on = false;
    for (BodyContact& contact : std::span(contacts_).first(contact_count_)) {
      const bool has_changed = apply_restitution(contact, solids_);
      goes_on = goes_on || has_changed;
    }
  }
}

// The velocities of a body that no springs hold have changed by the contacts' impulses alone. Those
// of the body itself do not count: after its move the same momentum is another angular velocity.
void BodyWorld::sum_impulses() {
  for (const std::uint8_t i : awake()) {
    pushed_[i].setZero();
  }
  for (const BodyContact& contact : std::span(contacts_).first(contact_count_)) {
    if (is_held(contact)) {
      add_impulses(contact, pushed_);
    }
  }
  grips_.add_spins(pushed_);
  for (const std::uint8_t i : awake()) {
    if (!grips_.holds(i)) {
      pushed_[i] = solids_[i].impulse_since_begin();
    }
  }
}

// The bodies' own velocities change only at the end of the sub-step: here a copy moves.
void BodyWorld::move_bodies(double step_s) {
  for (const std::uint8_t i : awake()) {
    RigidBody moving = bodies_[i];
    const Vec6 impulse = pushed_[i] + grips_.impulse_on(i, solids_);
    moving.push(impulse.head<3>(), impulse.tail<3>());
    moved_[i] << moving.motion().velocity_W, moving.angular_velocity_W();
    const Mat3 before = bodies_[i].motion().rotation_WO;
    moving.move(step_s);
    const BodyMotion& now = moving.motion();
    shifts_[i].translation_W += now.center_W - bodies_[i].motion().center_W;
    shifts_[i].rotation = now.rotation_WO * before.transpose() * shifts_[i].rotation;
    bodies_[i].take_place(moving);
  }
  for (std::size_t i = 0; i < obstacle_count_; ++i) {
    Shift& shift = shifts_[body_count_ + i];
    const Twist& twist = obstacles_[i].twist;
    shift.translation_W += step_s * twist.linear_W;
    shift.rotation = rotation_by(step_s * twist.angular_W) * shift.rotation;
  }
}

}  // namespace tactus::rendering
