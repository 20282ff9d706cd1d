#include "rendering/bodies/turn_friction.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// Returns the torques within the limits that the push of all points allows.
Vec3 within_limits(const BodyContact& contact, const Vec3& torque) {
  double push = 0.0;
  for (const SolvedPoint& point : std::span(contact.points).first(contact.count)) {
    push += point.push;
  }
  const double most_spin = contact.surface.spinning_m * push;
  const double most_roll = contact.surface.rolling_m * push;
  const double roll = std::sqrt(torque[1] * torque[1] + torque[2] * torque[2]);
  const double share = roll > most_roll ? most_roll / roll : 1.0;
  return {std::clamp(torque[0], -most_spin, most_spin), share * torque[1], share * torque[2]};
}

template <bool kHeld>
void apply_change(BodyContact& contact, const Vec3& torque, MeetingSolids<kHeld>& solids) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    solids.turn(contact.about[k], torque[i] - contact.torque[i]);
  }
  contact.torque = torque;
}

}  // namespace

void begin_turning(const PastContact* before, const SolverBody& a, const SolverBody& b,
                   BodyContact& contact) {
  Vec3 torque_W = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    PushDirection& about = contact.about[k];
    about.torques = spatial(contact.axes_W[k], -contact.axes_W[k]);
    set_answers(contact.axes_W, Vec3::Zero(), a, b, about);
    set_mass(0.0, about);
    if (before != nullptr) {
      torque_W += before->torque[static_cast<Eigen::Index>(k)] * before->axes_W[k];
    }
  }
  contact.torque = {torque_W.dot(contact.axes_W[0]), torque_W.dot(contact.axes_W[1]),
                    torque_W.dot(contact.axes_W[2])};
}

void follow_springs_turning(const SolverBody& a, const SolverBody& b, BodyContact& contact) {
  for (PushDirection& about : contact.about) {
    set_answers(contact.axes_W, Vec3::Zero(), a, b, about);
    set_mass(0.0, about);
  }
}

template <bool kHeld>
void warm_start_turning(BodyContact& contact, MeetingSolids<kHeld>& solids) {
  const Vec3 torque = within_limits(contact, contact.torque);
  contact.torque.setZero();
  apply_change(contact, torque, solids);
}

template <bool kHeld>
void solve_turning(BodyContact& contact, MeetingSolids<kHeld>& solids) {
  Vec3 wanted = contact.torque;
  for (std::size_t k = 0; k < 3; ++k) {
    wanted[static_cast<Eigen::Index>(k)] -=
        contact.about[k].mass * solids.turning(contact.about[k]);
  }
  apply_change(contact, within_limits(contact, wanted), solids);
}

template void warm_start_turning(BodyContact&, MeetingSolids<false>&);
template void warm_start_turning(BodyContact&, MeetingSolids<true>&);
template void solve_turning(BodyContact&, MeetingSolids<false>&);
template void solve_turning(BodyContact&, MeetingSolids<true>&);

Vec3 turning_torque_W(const BodyContact& contact) {
  return contact.torque[0] * contact.axes_W[0] + contact.torque[1] * contact.axes_W[1] +
         contact.torque[2] * contact.axes_W[2];
}

}  // namespace tactus::rendering
