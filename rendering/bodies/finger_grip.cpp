#include "rendering/bodies/finger_grip.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// Changes of mode in one sub-step; the last one stays.
constexpr int kModePasses = 4;

// Returns the matrix from a body's velocities to the velocity of a point.
Eigen::Matrix<double, 3, 6> jacobian(const Vec3& arm_W) {
  Eigen::Matrix<double, 3, 6> j;
  j << 1.0, 0.0, 0.0, 0.0, arm_W.z(), -arm_W.y(),  //
      0.0, 1.0, 0.0, -arm_W.z(), 0.0, arm_W.x(),   //
      0.0, 0.0, 1.0, arm_W.y(), -arm_W.x(), 0.0;
  return j;
}

// Returns the share of a finger's inertia h (B + h K) that its stiffness adds.
double stiff_share_of(const FingerGrip& grip, double step_s) {
  const double of_stiffness = step_s * grip.stiffness_N_per_m;
  const double both = of_stiffness + grip.damping_Ns_per_m;
  return both > 0.0 ? of_stiffness / both : 0.0;
}

}  // namespace

void FingerGrips::begin_tick(std::span<const FingerGrip> grips, std::span<const RigidBody> bodies,
                             double step_s) {
  step_s_ = step_s;
  std::array<double, kMostGrips> spins{};
  const std::size_t count = std::min(grips.size(), kMostGrips);
  for (std::size_t i = 0; i < count; ++i) {
    spins[i] = past_spin(grips[i]);
  }
  count_ = count;
  is_held_.fill(false);
  for (std::size_t i = 0; i < count_; ++i) {
    is_held_[grips[i].body] = true;
    grips_[i] = {.given = grips[i],
                 .arm_W = grips[i].point_W - bodies[grips[i].body].motion().center_W,
                 .stretch_force_W = -grips[i].spring_force_W,
                 .spin = spins[i]};
  }
}

Mat3 FingerGrips::springs_of(const SolvedGrip& grip) const {
  const FingerGrip& given = grip.given;
  const double whole = step_s_ * (given.damping_Ns_per_m + step_s_ * given.stiffness_N_per_m);
  const Mat3 along = given.normal_W * given.normal_W.transpose();
  switch (grip.mode) {
    case Mode::open:
      return Mat3::Zero();
    case Mode::slip:
      return whole * along;
    default: {
      const double rubbing =
          step_s_ * (given.share * given.damping_Ns_per_m + step_s_ * given.bristle_N_per_m);
      return whole * along + rubbing * (Mat3::Identity() - along);
    }
  }
}

Vec3 FingerGrips::impulse_of(const SolvedGrip& grip, const Vec3& body_v_W) const {
  if (grip.mode == Mode::open) {
    return Vec3::Zero();
  }
  const Vec3 spring = springs_of(grip) * (grip.given.tool_v_W - body_v_W);
  if (grip.mode == Mode::slip) {
    const Vec3& normal = grip.given.normal_W;
    return step_s_ * grip.stretch_force_W.dot(normal) * normal + spring + grip.rub;
  }
  return step_s_ * grip.stretch_force_W + spring;
}

Vec3 FingerGrips::possible(const SolvedGrip& grip, const Vec3& impulse) {
  const Vec3& normal = grip.given.normal_W;
  const double push = -impulse.dot(normal);
  if (!(push > 0.0)) {
    return Vec3::Zero();
  }
  const Vec3 rub = impulse + push * normal;
  const double most = grip.given.friction * push;
  const double size = rub.norm();
  return size > most ? Vec3{-push * normal + (most / size) * rub} : impulse;
}

bool FingerGrips::change_mode(SolvedGrip& grip, const Vec3& impulse) {
  const Vec3& normal = grip.given.normal_W;
  const double push = -impulse.dot(normal);
  if (grip.mode != Mode::open && !(push > 0.0)) {
    grip.mode = Mode::open;
    return true;
  }
  const Vec3 allowed = possible(grip, impulse);
  if (grip.mode == Mode::stick && allowed != impulse) {
    grip.mode = Mode::slip;
    grip.rub = allowed + push * normal;
    return true;
  }
  return false;
}

void FingerGrips::hold(std::uint32_t body, SolverBody& solver) {
  const SolverBody free = solver;
  for (int pass = 0; pass < kModePasses; ++pass) {
    Mat6 inertia = Mat6::Zero();
    Vec6 wrench = Vec6::Zero();
    double stiff_share = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      SolvedGrip& grip = grips_[i];
      if (grip.given.body == body) {
        grip.mode = pass == 0 ? Mode::stick : grip.mode;
        const auto J = jacobian(grip.arm_W);
        inertia += J.transpose() * springs_of(grip) * J;
        wrench += wrench_of(impulse_of(grip, free.velocity_at(grip.arm_W)), grip.arm_W);
        stiff_share = std::max(stiff_share, stiff_share_of(grip.given, step_s_));
      }
    }
    solver = free;
    solver.set_springs(inertia, stiff_share);
    solver.accelerate(wrench);
    bool has_changed = false;
    for (std::size_t i = 0; i < count_ && pass + 1 < kModePasses; ++i) {
      SolvedGrip& grip = grips_[i];
      if (grip.given.body == body) {
        const Vec3 impulse = impulse_of(grip, solver.velocity_at(grip.arm_W));
        has_changed = change_mode(grip, impulse) || has_changed;
      }
    }
    if (!has_changed) {
      return;
    }
  }
}

Vec6 FingerGrips::impulse_on(std::uint32_t body, std::span<const SolverBody> bodies) {
  Vec6 sum = Vec6::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    SolvedGrip& grip = grips_[i];
    if (grip.given.body == body) {
      const Vec3 wanted = impulse_of(grip, bodies[body].velocity_at(grip.arm_W));
      grip.impulse = possible(grip, wanted);
      sum += wrench_of(grip.impulse, grip.arm_W);
    }
  }
  return sum;
}

void FingerGrips::end_step(std::span<const Vec6> moved) {
  for (std::size_t i = 0; i < count_; ++i) {
    SolvedGrip& grip = grips_[i];
    const FingerGrip& given = grip.given;
    grip.total += grip.impulse;
    const Vec6& velocity = moved[given.body];
    const Vec3 slip = given.tool_v_W - velocity.head<3>() - velocity.tail<3>().cross(grip.arm_W);
    const Vec3 across = slip.dot(given.normal_W) * given.normal_W;
    grip.stretch_force_W +=
        step_s_ * (given.stiffness_N_per_m * across + given.bristle_N_per_m * (slip - across));
  }
}

}  // namespace tactus::rendering
