#include "rendering/bodies/body_solver.h"

namespace tactus::rendering {
namespace {

// Each pass of a sub-step solves all contacts so often.
constexpr int kPasses = 2;
// Bounces are solved so often at most.
constexpr int kMostBouncePasses = 16;
// The frequency of the spring that undoes overlaps is this share of the sub-steps' rate, and it is
// damped far beyond its critical damping.
constexpr double kContactShare = 0.25;
constexpr double kContactDamping = 10.0;

}  // namespace

void BodySolver::take_body(const SolidList& solids, std::size_t body) {
  velocities_[body].take(solids.bodies()[body]);
  shifts_[body] = {};
}

void BodySolver::take_obstacles(const SolidList& solids) {
  std::size_t solid = solids.body_count();
  for (const BodyObstacle& obstacle : solids.obstacles()) {
    velocities_[solid].take_obstacle(obstacle.X_WO.translation, obstacle.twist);
    shifts_[solid++] = {};
  }
}

void BodySolver::solve(const SolvedTick& tick) {
  for (int i = 0; i < kSubSteps; ++i) {
    sub_step(tick, i + 1 == kSubSteps);
  }
}

void BodySolver::sub_step(const SolvedTick& tick, bool is_last) {
  const ContactSoftness softness =
      contact_softness(kContactShare / tick.step_s, kContactDamping, tick.step_s);
  for (const std::uint8_t i : tick.awake) {
    tick.solids.body(i).accelerate(tick.gravity_W, tick.step_s);
    velocities_[i].begin(tick.solids.body(i));
  }
  for (BodyContact& contact : tick.contacts) {
    if (tick.is_held(contact)) {
      follow_springs(velocities_, contact);
    }
    warm_start(contact, velocities_);
  }
  solve_contacts(tick, &softness);
  sum_impulses(tick);
  move_bodies(tick);
  for (BodyContact& contact : tick.contacts) {
    follow_motion(contact, shifts_);
  }
  solve_contacts(tick, nullptr);
  if (is_last) {
    bounce(tick.contacts);
  }
  sum_impulses(tick);
  for (const std::uint8_t i : tick.awake) {
    const Vec6 impulse = pushed_[i] + tick.grips.impulse_on(i, velocities_);
    tick.solids.body(i).push(impulse.head<3>(), impulse.tail<3>());
  }
  tick.grips.end_step(moved_);
}

// The impulses of contacts decide which fingers let go or slip, and they change in each pass. Where
// they are those of the pass before, as of a body without contacts, the springs are solved already.
void BodySolver::hold_bodies(const SolvedTick& tick) {
  if (!tick.grips.any()) {
    return;
  }
  sum_impulses(tick);
  bool has_changed = false;
  for (const std::uint8_t i : tick.awake) {
    const bool is_solved = velocities_[i].has_springs() && pushed_[i] == held_against_[i];
    if (tick.grips.holds(i) && !is_solved) {
      velocities_[i].begin(tick.solids.body(i));
      velocities_[i].accelerate(pushed_[i]);
      tick.grips.hold(i, velocities_[i]);
      held_against_[i] = pushed_[i];
      has_changed = true;
    }
  }
  if (!has_changed) {
    return;
  }
  for (BodyContact& contact : tick.contacts) {
    if (tick.is_held(contact)) {
      follow_springs(velocities_, contact);
    }
  }
  tick.grips.limit_spins(velocities_);
}

void BodySolver::solve_contacts(const SolvedTick& tick, const ContactSoftness* softness) {
  for (int pass = 0; pass < kPasses; ++pass) {
    hold_bodies(tick);
    tick.grips.solve_spins(velocities_);
    for (BodyContact& contact : tick.contacts) {
      solve_contact(contact, velocities_, tick.step_s, softness);
    }
  }
}

// The bounces of the points of a contact, and of neighbours, depend on each other.
void BodySolver::bounce(std::span<BodyContact> contacts) {
  bool goes_on = true;
  for (int pass = 0; goes_on && pass < kMostBouncePasses; ++pass) {
    goes_on = false;
    for (BodyContact& contact : contacts) {
      const bool has_changed = apply_restitution(contact, velocities_);
      goes_on = goes_on || has_changed;
    }
  }
}

// The velocities of a body that no springs hold have changed by the contacts' impulses alone. Those
// of the body itself do not count: after its move the same momentum is another angular velocity.
void BodySolver::sum_impulses(const SolvedTick& tick) {
  for (const std::uint8_t i : tick.awake) {
    pushed_[i].setZero();
  }
  for (const BodyContact& contact : tick.contacts) {
    if (tick.is_held(contact)) {
      add_impulses(contact, pushed_);
    }
  }
  tick.grips.add_spins(pushed_);
  for (const std::uint8_t i : tick.awake) {
    if (!tick.grips.holds(i)) {
      pushed_[i] = velocities_[i].impulse_since_begin();
    }
  }
}

// The bodies' own velocities change only at the end of the sub-step: here a copy moves.
void BodySolver::move_bodies(const SolvedTick& tick) {
  for (const std::uint8_t i : tick.awake) {
    RigidBody& body = tick.solids.body(i);
    RigidBody moving = body;
    const Vec6 impulse = pushed_[i] + tick.grips.impulse_on(i, velocities_);
    moving.push(impulse.head<3>(), impulse.tail<3>());
    moved_[i] << moving.motion().velocity_W, moving.angular_velocity_W();
    const Mat3 before = body.motion().rotation_WO;
    moving.move(tick.step_s);
    const BodyMotion& now = moving.motion();
    shifts_[i].translation_W += now.center_W - body.motion().center_W;
    shifts_[i].rotation = now.rotation_WO * before.transpose() * shifts_[i].rotation;
    body.take_place(moving);
  }
  std::size_t solid = tick.solids.body_count();
  for (const BodyObstacle& obstacle : tick.solids.obstacles()) {
    Shift& shift = shifts_[solid++];
    shift.translation_W += tick.step_s * obstacle.twist.linear_W;
    shift.rotation = rotation_by(tick.step_s * obstacle.twist.angular_W) * shift.rotation;
  }
}

}  // namespace tactus::rendering
