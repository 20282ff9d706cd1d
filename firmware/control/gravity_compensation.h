// Holds the mechanism's own weights up, so that the hand does not have to.
//
// What is given is dU/dq of the weights in the mechanism's geometry, at the joints' positions of
// this tick (kinematics/link_weight.h). It is a feed-forward: it takes no part in the rendered
// force, and the hand feels none of it as long as the weights are right. It rises with the soft
// start, and is none in every mode but `active`. Off while all weights are zero.
//
// It goes first: the rendered force is scaled into what it leaves of each joint's effort, since an
// arm that sagged while the hand pressed would make the rendered force wrong. Beyond a joint's own
// limit it is cut there.
#pragma once

#include <array>

#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/mechanism.h"
#include "rendering/geometry/vector.h"
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

struct GravityHold {
  Vec3 effort = Vec3::Zero();  // N or N m
  bool is_held_back = false;   // by a joint's effort limit
};

class GravityCompensation {
 public:
  void configure(const ControllerConfig& config);

  // Takes the soft start alone: a gain that rises goes on from where it is.
  void retune(const ControllerConfig& config);

  [[nodiscard]] bool is_on() const { return is_on_; }

  // In every tick that is not active: the next hold starts from none.
  void rest() { gain_ = 0.0; }

  // Once in every active tick, at a good pose of these joints.
  GravityHold hold(const Mechanism& mechanism, const Vec3& joints, const Pose& pose);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  bool is_on_ = false;
  double gain_per_tick_ = 1.0;
  double gain_ = 0.0;
  Vec3 gravity_D_ = Vec3::Zero();
  std::array<JointLimits, kJointCount> limits_{};
};

}  // namespace tactus::firmware
