// Finds encoders that stand still, jump, or do not move with their motor. One thread; real time.
// Positions q are in rad or m, efforts tau in N m or N, and T is the period.
//
//  - encoder_jump: |q - last| > max_joint_speed T (ticks since the last fresh sample).
//  - encoder_frozen: q is the same to the bit while the velocity q' says that the joint moves: the
//    integral of |q'| since q last changed passes frozen_travel. A joint slower than frozen_travel
//    a second counts as standing still.
//  - torque_without_motion: q has been the same to the bit since the joint's effort was tau0, and
//    |tau - tau0| has been above blocked_effort_share of its largest effort for blocked_s. A hand
//    that resists is not found: it yields by some counts while the force rises.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// One effort for each joint, N m or N.
using JointEfforts = std::array<double, drivers::kMaxJoints>;

// The guard of all encoders of a mechanism.
class EncoderGuard {
 public:
  // Takes rate and thresholds, and forgets the joints.
  void configure(const ControllerConfig& config);

  // Forgets the joints' positions. Call when their zero changes.
  void rest() { is_placed_ = false; }

  // Returns the FaultBits of a finite sample of a referenced device. `held` are the efforts
  // commanded by the previous tick, N or N m. `missed_ticks` is the number of ticks since then
  // without any sample.
  std::uint64_t check(const drivers::JointSample& sample, const JointEfforts& held,
                      std::uint32_t missed_ticks);

  // Replaces check() for a sample that must not be used. The joints may move on in that tick.
  void pass() { ++passed_ticks_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // The memory of one joint.
  struct Joint {
    // The last position, rad or m.
    double position = 0.0;
    // The integral of |velocity| since the position last changed, rad or m.
    double travel = 0.0;
    // The effort when the position last changed.
    double effort = 0.0;
    // A larger change of the effort must move the joint.
    double blocked_step = 0.0;
    std::uint32_t blocked_ticks = 0;
  };

  // Takes one joint's values and returns its FaultBits. `elapsed_ticks` have passed since the last
  // ones.
  std::uint64_t check_joint(Joint& joint, double position, double velocity, double effort,
                            double elapsed_ticks) const;

  std::array<Joint, kJointCount> joints_{};
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 0.001;
  // The largest step of a position in one tick, rad or m.
  double max_step_ = 0.0;
  double frozen_travel_ = 0.0;
  std::uint32_t blocked_ticks_to_fault_ = 0;
  // The number of ticks since the last check.
  std::uint32_t passed_ticks_ = 0;
  bool is_placed_ = false;
};

}  // namespace tactus::firmware
