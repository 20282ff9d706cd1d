// Encoders that stand still, jump, or do not answer to their motor.
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
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

using JointEfforts = std::array<double, drivers::kMaxJoints>;

class EncoderGuard {
 public:
  void configure(const ControllerConfig& config);

  // Forgets where the joints were: they have, or will get, another zero.
  void rest() { is_placed_ = false; }

  // FaultBits of a finite sample of a referenced device. `held` are the efforts commanded by the
  // tick before; `missed_ticks` have no sample at all.
  std::uint64_t check(const drivers::JointSample& sample, const JointEfforts& held,
                      std::uint32_t missed_ticks);

  // Instead of check() for a sample that is not to be looked at: the joints go on meanwhile.
  void pass() { ++passed_ticks_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  struct Joint {
    double position = 0.0;
    double travel = 0.0;        // by its velocity, since the position last changed
    double effort = 0.0;        // when it last changed
    double blocked_step = 0.0;  // a larger change of effort has to move it
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
