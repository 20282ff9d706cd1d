// Pushes each joint along its motion, against the joint's own friction, so that the hand feels less
// of it. It is off unless a joint has a compensated_share. One thread; real time.
//
// The push. A joint's friction is at least its Coulomb level Fc plus its viscous term; the Stribeck
// effect adds more near rest. The compensation gives a share s of those two back:
//   c = s Fc u + s sigma2 v,   du/dq = (sgn(v) - u) / l.
// u is a bristle without unit, between -1 and 1, by Dahl's model
// (rendering/friction/models/dahl.h). sgn(v) itself would jump between -1 and 1 with every count of
// an encoder at rest. u changes its sign over the displacement l, the longer of the friction's
// presliding length Fs / sigma0 and `turn_length`. The joint's position drives u; v is the device's
// estimate of the velocity after the controller's low-pass.
//
// Stability: the push does not move the device by itself, if s is chosen so that the true friction
// is at least s Fc and s sigma2 v. There are five cases.
//  - While a joint slides, its friction dissipates at least Fc |dq| and the bristle gives at most s
//    Fc |dq|. This holds for any delay, encoder resolution and state of the bristle.
//  - While a joint sticks, the friction is a yielding spring of stiffness sigma0, and the push is a
//    negative yielding spring of s Fc / l <= s sigma0. Their sum is a positive spring with the
//    share 1 - s of the friction's hysteresis loop. A step of one count moves a stuck joint by less
//    than a count, so it causes no further step. Therefore l must not be shorter than the
//    friction's presliding length: otherwise the push would give more energy in a small loop than
//    the friction dissipates, and the device would hum.
//  - A delay makes the bristle's push smaller: the held push belongs to an earlier position, and u
//    grows along the motion in either direction.
//  - The viscous part passes a low-pass and a delay, with a gain of at most 1 at every frequency.
//    Over a whole motion it gives at most s sigma2 times the integral of v^2.
//  - At rest the push does not fade, because a fading push would give more energy than it took. It
//    is at most s Fc, below the friction that holds a joint at rest.
//
// Limits. All pushes are scaled by one factor so that each joint's whole effort stays within its
// limit, and so that their force at the tool without any friction fits into the part of max_force_N
// that the rendered force leaves: the rendered force has priority. The pushes rise with the soft
// start. In every mode but `active` they are zero and the memory is cleared.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/configuration/controller_config.h"
#include "firmware/control/velocity_filter.h"
#include "firmware/kinematics/pose.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The limits of the pushes in a tick.
struct PushRoom {
  const Pose& pose;
  // The efforts that are commanded already, within their limits, N or N m.
  Vec3 effort = Vec3::Zero();
  // The force at the tool, N, that is left up to max_force_N.
  double force_N = 0.0;
};

// The pushes of a tick.
struct FrictionPush {
  // The efforts along the motion, N or N m.
  Vec3 effort = Vec3::Zero();
  // True if the limits scaled them down.
  bool is_held_back = false;
};

// The compensation of all joints of a mechanism.
class FrictionCompensation {
 public:
  // Takes the joints' friction, limits and soft start, and clears the memory.
  void configure(const ControllerConfig& config);

  // Takes a new soft start and velocity cutoff. Bristles and gain continue from where they are.
  void retune(const ControllerConfig& config);

  // Returns true if any joint has a compensated_share.
  [[nodiscard]] bool is_on() const { return is_on_; }

  // Clears the memory, so that the next push starts from zero. Call in every tick that is not
  // active.
  void rest();

  // Returns the pushes for the joints' positions and velocities. Call once in every active tick.
  // The result may be not finite if a velocity is too large.
  FrictionPush push(const Vec3& position, const Vec3& velocity, const PushRoom& room);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  struct Joint {
    rendering::FrictionParameters bristle;  // s Fc u, as Dahl's model
    rendering::FrictionMemory<double> memory;
    double viscous = 0.0;  // s sigma2
  };

  // Returns the factor in [0, 1] by which the pushes fit into the limits.
  [[nodiscard]] double share_that_fits(const Vec3& effort, const PushRoom& room) const;

  bool is_on_ = false;
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 1e-3;
  // The soft start: the gain rises by gain_per_tick_ in each active tick, up to 1.
  double gain_per_tick_ = 1.0;
  double gain_ = 0.0;
  VelocityFilter velocity_filter_;
  bool is_placed_ = false;  // last_position_ is valid
  // The joints' positions at the last push, rad or m.
  Vec3 last_position_ = Vec3::Zero();
  std::array<Joint, kJointCount> joints_{};
  std::array<JointLimits, kJointCount> limits_{};
};

}  // namespace tactus::firmware
