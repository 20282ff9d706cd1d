#include "rendering/bodies/body_world.h"

namespace tactus::rendering {

void BodyWorld::clear() {
  solids_.clear();
  contacts_.clear();
  gravity_W_ = Vec3::Zero();
  grips_.clear(0.0);
  sleep_.start(0.0);
}

void BodyWorld::step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W) {
  for (const FingerGrip& grip : grips) {
    sleep_.wake(grip.body);
  }
  awake_.list(sleep_, solids_.body_count());
  if (!is_all_asleep()) {
    step_awake(tick_s, grips);
  } else {
    contacts_.clear();
  }
  for (std::size_t i = 0; i < forces_W.size(); ++i) {
    forces_W[i] = grips_.force_on_hand(i, tick_s);
  }
}

void BodyWorld::step_awake(double tick_s, std::span<const FingerGrip> grips) {
  for (const std::uint8_t i : awake_.numbers()) {
    solver_.take_body(solids_, i);
  }
  solver_.take_obstacles(solids_);
  const double step_s = tick_s / BodySolver::kSubSteps;
  grips_.begin_tick(grips, bodies(), step_s);
  find_contacts(tick_s);
  solver_.solve({.solids = solids_,
                 .awake = awake_.numbers(),
                 .contacts = contacts_.all(),
                 .grips = grips_,
                 .gravity_W = gravity_W_,
                 .step_s = step_s});
  rest_bodies(tick_s, grips);
}

std::size_t BodyWorld::point_count() const {
  std::size_t count = 0;
  for (const BodyContact& contact : contacts_.all()) {
    count += contact.count;
  }
  return count;
}

}  // namespace tactus::rendering
