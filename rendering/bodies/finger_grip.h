// Fingers that hold bodies. The spring and the damper between a tool and its proxy are integrated
// implicitly together with the body, so that no body is too light for them:
//
//   force on the body f = K (c + h u) + B u,   u = v_tool - v_body at the end of the step h
//
// with the tool's distance c beyond the proxy. In the terms of a soft constraint (Catto, "Soft
// constraints", GDC 2011) it is gamma = 1 / (h (B + h K)) and beta = h K / (B + h K). All fingers
// on a body are solved at once: they add h (B + h K) J' J to its inertia, where J gives the
// velocity of the touched point.
//
// An explicit spring would be unstable on bodies below K h^2 / 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/rigid_body.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// The most planes by which one tool holds bodies: those of its proxy.
inline constexpr std::size_t kGripsOfTool = 3;
inline constexpr std::size_t kMostGrips = kMaxTools * kGripsOfTool;

// One plane of a tool's contact with a body, as the touch of this tick has found it. World frame.
struct FingerGrip {
  // The number of the body.
  std::uint32_t body = 0;
  // The point of the body's surface that is touched, m, and the unit normal there, outward.
  Vec3 point_W = Vec3::Zero();
  Vec3 normal_W = Vec3::UnitY();
  // The spring's force on the hand in this tick, N: K times the way from the tool to the proxy.
  Vec3 spring_force_W = Vec3::Zero();
  // The stiffness K along the normal, N/m, and the damping B, Ns/m.
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  // The share of K and B that acts along the surface; the shares of one tool's planes add up to 1.
  double share = 1.0;
  // The largest friction over the normal force.
  double friction = 0.0;
  // The velocity of the tool, m/s.
  Vec3 tool_v_W = Vec3::Zero();
};

// The grips of one tick.
class FingerGrips {
 public:
  // Takes the grips, at most kMostGrips; arms lead from the bodies' centres.
  void begin_tick(std::span<const FingerGrip> grips, std::span<const RigidBody> bodies);

  // Begins a sub-step: gives the springs' inertia to the bodies that are held, and the springs'
  // impulses. Fingers that would pull let go, and those that would rub too hard slip.
  void begin_step(std::span<SolverBody> bodies, double step_s);

  // Returns the impulses of a body's grips for its velocities now, with their torque.
  [[nodiscard]] Vec6 impulse_on(std::uint32_t body, std::span<const SolverBody> bodies);

  // Ends a sub-step: counts the last impulses, and stretches the springs by the bodies' motion with
  // the velocities of `moved`.
  void end_step(std::span<const Vec6> moved);

  // Returns the force of a grip on the hand: minus the sum of its impulses over the tick, N.
  [[nodiscard]] Vec3 force_on_hand(std::size_t grip, double tick_s) const {
    return -grips_[grip].total / tick_s;
  }

 private:
  enum class Mode : std::uint8_t { open, slip, stick };
  struct SolvedGrip {
    FingerGrip given;
    Vec3 arm_W = Vec3::Zero();
    // K times the tool's distance beyond the proxy, N.
    Vec3 stretch_force_W = Vec3::Zero();
    Mode mode = Mode::stick;
    // The impulse along the surface of a finger that slips.
    Vec3 rub = Vec3::Zero();
    // The impulse on the body in this sub-step, and in the tick; N s.
    Vec3 impulse = Vec3::Zero();
    Vec3 total = Vec3::Zero();
  };

  // Returns the matrix from the velocity to the impulse of a grip, kg.
  [[nodiscard]] Mat3 springs_of(const SolvedGrip& grip) const;
  // Returns the impulse of a grip at this velocity of the body's point.
  [[nodiscard]] Vec3 impulse_of(const SolvedGrip& grip, const Vec3& body_v_W) const;
  // Returns the impulse within what a finger can do: no pull, and no more friction than the cone's.
  static Vec3 possible(const SolvedGrip& grip, const Vec3& impulse);
  // Changes the mode of a grip whose impulse is not possible. Returns true if it has.
  static bool change_mode(SolvedGrip& grip, const Vec3& impulse);
  // Solves one body with its grips.
  void hold(std::uint32_t body, SolverBody& solver);

  std::array<SolvedGrip, kMostGrips> grips_;
  std::size_t count_ = 0;
  double step_s_ = 1e-3;
};

}  // namespace tactus::rendering
