// Holds the mechanism's own weights, so that the hand does not have to. One thread; real time.
//
// The effort is dU/dq of the weights in the mechanism's geometry, at this tick's joint positions
// (kinematics/link_weight.h). It is a feed-forward and not part of the rendered force; the hand
// does not feel it if the weights are right. It rises with the soft start and is zero in every mode
// but `active`. It is off if all weights are zero.
//
// It has priority: the rendered force is scaled into the rest of each joint's effort, because an
// arm that sags while the hand presses makes the rendered force wrong. It is cut at a joint's own
// limit.
#pragma once

#include <array>

#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/mechanism.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The efforts of a tick.
struct GravityHold {
  // The efforts that hold the weights, N or N m.
  Vec3 effort = Vec3::Zero();
  // True if a joint's effort limit cut one of them.
  bool is_held_back = false;
};

// The compensation of one mechanism.
class GravityCompensation {
 public:
  // Takes gravity, limits and soft start, and clears the gain.
  void configure(const ControllerConfig& config);

  // Takes a new soft start. A rising gain continues from where it is.
  void retune(const ControllerConfig& config);

  // Returns true if the mechanism has a weight and there is gravity.
  [[nodiscard]] bool is_on() const { return is_on_; }

  // Clears the gain, so that the next hold starts from zero. Call in every tick that is not active.
  void rest() { gain_ = 0.0; }

  // Returns the efforts at a good pose of these joints. Call once in every active tick.
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
