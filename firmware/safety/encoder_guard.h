// Finds encoders that stand still, jump, or do not move with their motor.
//
//  jump     |q - last| > max_joint_speed T (ticks since the last fresh sample)
//  frozen   q is the same to the bit while the integral of |q'| since it last changed, which is how
//           far the joint says it went, passes frozen_travel; slower than frozen_travel a second
//           it stands still
//  torque without motion
//           q is the same to the bit since the joint's effort was tau0, and |tau - tau0| has been
//           above blocked_effort_share of its largest effort for blocked_s. A hand that resists
//           holds still to within counts, not to within none: it yields while the force rises.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

using JointEfforts = std::array<double, drivers::kMaxJoints>;

class EncoderGuard {
 public:
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
  struct Joint {
    double position = 0.0;
    double travel = 0.0;        // integral of |velocity| since the position last changed
    double effort = 0.0;        // effort when the position last changed
    double blocked_step = 0.0;  // a larger change of effort must move the joint
    std::uint32_t blocked_ticks = 0;
  };

  std::uint64_t check_joint(Joint& joint, double position, double velocity, double effort,
                            double elapsed_ticks) const;

  std::array<Joint, kJointCount> joints_{};
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 0.001;
  double max_step_ = 0.0;
  double frozen_travel_ = 0.0;
  std::uint32_t blocked_ticks_to_fault_ = 0;
  std::uint32_t passed_ticks_ = 0;
  bool is_placed_ = false;
};

}  // namespace tactus::firmware
