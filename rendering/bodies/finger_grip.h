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
//
// A soft finger touches with a disc and not with a point (Hertz), so that it also holds a body from
// turning about the contact normal. This friction is a constraint of the solver, that the body does
// not turn about the normal, with a torque that is at most
//
//   (3 pi / 16) friction N a,   a = (yield N)^(1/3),   yield = 3 R / (4 E*)
//
// under the normal force N of a sphere of radius R (Johnson, "Contact mechanics", 1985, 4.2
// and 7.4). E* is the effective modulus of both surfaces. The limits along the surface and about
// the normal do not depend on each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/rigid_body.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// The most planes by which one tool holds bodies: those of its proxy.
inline constexpr std::size_t kGripsOfTool = 3;
inline constexpr std::size_t kMostGrips = kMaxTools * kGripsOfTool;

// One plane of a tool's contact with a body, as the touch of this tick has found it. World frame.
struct FingerGrip {
  // The numbers of the body and of the tool.
  std::uint32_t body = 0;
  std::uint32_t tool = 0;
  // The point of the body's surface that is touched, m, and the unit normal there, outward.
  Vec3 point_W = Vec3::Zero();
  Vec3 normal_W = Vec3::UnitY();
  // The spring's force on the hand in this tick, N: K times the distance from the tool to the
  // proxy.
  Vec3 spring_force_W = Vec3::Zero();
  // The stiffness K along the normal, N/m, and the damping B, Ns/m.
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  // The share of B that acts along the surface; the shares of one tool's planes add up to 1.
  double share = 1.0;
  // The stiffness along the surface, N/m: this plane's part of K, or of the friction model's
  // bristle.
  double bristle_N_per_m = 0.0;
  // The largest friction over the normal force.
  double friction = 0.0;
  // The velocity of the tool, m/s.
  Vec3 tool_v_W = Vec3::Zero();
};

// The grips of one tick.
class FingerGrips {
 public:
  // Starts over without grips. `yield_m3_per_N` is that of soft fingers, 0 for points.
  void clear(double yield_m3_per_N) {
    count_ = 0;
    is_held_.fill(false);
    yield_m3_per_N_ = yield_m3_per_N;
  }

  // Takes the grips, at most kMostGrips, of a tick in sub-steps of this length; arms lead from the
  // bodies' centres. The torques of soft fingers go on.
  void begin_tick(std::span<const FingerGrip> grips, std::span<const RigidBody> bodies,
                  double step_s);

  // Return true if fingers hold any body in this tick, or this one.
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] bool holds(std::size_t body) const { return body < kMaxBodies && is_held_[body]; }

  // Gives a body the inertia of its springs, and their impulses. Fingers that would pull let go,
  // and those that would rub too hard slip. The body's velocities must be those that gravity and
  // the impulses of contacts make without springs: they decide what a finger can do, and a contact
  // that has changed them calls for this anew.
  void hold(std::uint32_t body, SolverBody& solver);

  // Takes the torques of soft fingers, which must be in the velocities, within their limits. It
  // comes after hold().
  void limit_spins(std::span<SolverBody> bodies);
  // Stops the turning of bodies about the normals of soft fingers once, within the limits.
  void solve_spins(std::span<SolverBody> bodies);
  // Adds the torques of soft fingers in this sub-step to the impulses on each body.
  void add_spins(std::span<Vec6> wrenches) const;

  // Returns the impulses of a body's grips for its velocities now, with their torque; those of
  // add_spins() are not among them.
  [[nodiscard]] Vec6 impulse_on(std::uint32_t body, std::span<const SolverBody> bodies);

  // Ends a sub-step: counts the last impulses, and stretches the springs by the bodies' motion with
  // the velocities of `moved`.
  void end_step(std::span<const Vec6> moved);

  // Returns the force of a grip on the hand: minus the sum of its impulses over the tick, N.
  [[nodiscard]] Vec3 force_on_hand(std::size_t grip, double tick_s) const {
    return -grips_[grip].total / tick_s;
  }

  // Saves the torques of soft fingers to the archive, or restores them; grips of points have no
  // state.
  void transfer(StateArchive& archive, std::uint32_t bodies);

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
    // The torque about the normal in this sub-step, N m s, the body's answer to a unit of it, and
    // the inertia that it turns, kg m^2.
    double spin = 0.0;
    Vec6 spin_answer = Vec6::Zero();
    double spin_inertia = 0.0;
  };

  // Returns the matrix from the velocity to the impulse of a grip, kg.
  [[nodiscard]] Mat3 springs_of(const SolvedGrip& grip) const;
  // Returns the impulse of a grip at this velocity of the body's point.
  [[nodiscard]] Vec3 impulse_of(const SolvedGrip& grip, const Vec3& body_v_W) const;
  // Returns the impulse within what a finger can do: no pull, and no more friction than the cone's.
  static Vec3 possible(const SolvedGrip& grip, const Vec3& impulse);
  // Changes the mode of a grip whose impulse is not possible. Returns true if it has.
  static bool change_mode(SolvedGrip& grip, const Vec3& impulse);
  // Returns the torque of a soft finger in the last tick, or 0 if it has not held the body there.
  [[nodiscard]] double past_spin(const FingerGrip& grip) const;
  // Returns the largest torque about the normal at these velocities of the body, N m s.
  [[nodiscard]] double most_spin(const SolvedGrip& grip, const SolverBody& body) const;

  std::array<SolvedGrip, kMostGrips> grips_;
  std::size_t count_ = 0;
  // True for a body that a finger holds in this tick.
  std::array<bool, kMaxBodies> is_held_{};
  double step_s_ = 1e-3;
  double yield_m3_per_N_ = 0.0;
};

}  // namespace tactus::rendering
