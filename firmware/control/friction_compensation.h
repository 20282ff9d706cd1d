// Pushes each joint along its motion, against the joint's own friction, so that the hand feels less
// of it. Off unless a joint has a share.
//
// What is pushed. A joint's friction is at least its Coulomb level Fc and its viscous term,
// whatever the Stribeck hump adds on top near rest. A share s of those two is given back:
//   c = s Fc u + s sigma2 v,   du/dq = (sgn(v) - u) / l.
// u is a bristle without unit, between -1 and 1: Dahl's model (rendering/friction/dahl.h), and not
// sgn(v), which would jump from -1 to 1 with every count of an encoder at rest. It turns round over
// the displacement l, the longer of the friction's own presliding length Fs / sigma0 and of
// `turn_length`. It is driven by the joint's position; v is the device's estimate of its velocity,
// through the controller's low-pass.
//
// Why it does not move the device by itself. Let the true friction be at least s Fc and s sigma2 v:
// let s be less than one by what the fit may be wrong.
//  - While a joint slides, its friction takes at least Fc |dq|, and the bristle gives at most
//    s Fc |dq|: whatever the delay, the counting of the encoder and the state of the bristle.
//  - While it sticks, the friction is a spring of sigma0 that yields, and the push a negative
//  spring
//    of s Fc / l <= s sigma0 that yields alike: what is left is a positive spring and the share
//    1 - s of the loop that the friction takes. A step of one count moves a stuck joint by less
//    than a count, so that it causes no further step. That is why l is not shorter than the
//    friction's own: a push that turns round sooner than the friction takes over gives out more in
//    a small loop than the friction takes, and hums.
//  - Being late makes it give less: a held push is that of an earlier place, and u grows along the
//    motion, so that for either direction the push held is below the one due. The viscous part
//    passes a low-pass and a delay, whose gain is at most 1 at every frequency: over a whole motion
//    it gives at most s sigma2 times the integral of v^2.
//  - A push that faded with time at rest would give out more than it took: the bristle keeps it,
//    s Fc at most, which is below what a joint at rest holds.
//
// Limits. All pushes are scaled alike so that each joint's whole effort stays within its limit, and
// the force that they would be at the tool, if there were no friction at all, fits into what the
// rendered force leaves of max_force_N: the rendered force goes first. They rise with the soft
// start. In every mode but `active` there is none, and nothing is remembered.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/configuration/controller_config.h"
#include "firmware/control/velocity_filter.h"
#include "firmware/kinematics/pose.h"
#include "rendering/friction/friction_model.h"
#include "rendering/geometry/vector.h"
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

// What the pushes have to fit into.
struct PushRoom {
  const Pose& pose;
  Vec3 effort = Vec3::Zero();  // what the joints give already, within their limits
  double force_N = 0.0;        // that max_force_N leaves at the tool
};

struct FrictionPush {
  Vec3 effort = Vec3::Zero();  // N or N m, along the motion
  bool is_held_back = false;   // by the room
};

class FrictionCompensation {
 public:
  void configure(const ControllerConfig& config);

  // Takes the soft start and the velocity's cutoff alone: bristles and gain go on from where they
  // are.
  void retune(const ControllerConfig& config);

  // Whether any joint has a share.
  [[nodiscard]] bool is_on() const { return is_on_; }

  // In every tick that is not active: the next push starts from none.
  void rest();

  // Once in every active tick, with the joints' positions and velocities. The result may be not
  // finite if the velocity is too large.
  FrictionPush push(const Vec3& position, const Vec3& velocity, const PushRoom& room);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  struct Joint {
    rendering::FrictionParameters bristle;  // s Fc u, as Dahl's model
    rendering::FrictionMemory<double> memory;
    double viscous = 0.0;  // s sigma2
  };

  [[nodiscard]] double share_that_fits(const Vec3& effort, const PushRoom& room) const;

  bool is_on_ = false;
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 1e-3;
  double gain_per_tick_ = 1.0;
  double gain_ = 0.0;
  VelocityFilter velocity_filter_;
  bool is_placed_ = false;  // last_position_ is the tick's before
  Vec3 last_position_ = Vec3::Zero();
  std::array<Joint, kJointCount> joints_{};
  std::array<JointLimits, kJointCount> limits_{};
};

}  // namespace tactus::firmware
