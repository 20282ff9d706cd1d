// Finds motors that push the wrong way, or with another effort than commanded.
//
// Joint i moves the tool by L_i metres a unit of it, the length of column i of the Jacobian. In a
// hand's units its effort is then f = tau / L and its speed u = q' L, and
//   M du/dt = k f + h
// with a mass M of device and hand, the hand's own push h, and k = 1 for a joint that is wired
// right, -1 for one that is reversed. A surface makes f grow with the depth, so behind a reversed
// motor speed and effort drive each other: both grow by the same power of e, and M du/dt keeps up
// with f. A hand that presses drives the speed alone: to do the same it has to push twice as hard
// as the surface, and its push has to grow as fast. So both growths are summed while
//   f > kLeast_N, u > kLeast_m_per_s against f, both rising, and M |du/dt| > kShare f.
//
//  motor reversed   the smaller growth passes kGrowth: the effort and the speed against it have
//                   both become e^kGrowth times as large. This needs motion: a firm hand that
//                   yields slowly to a reversed motor looks like one that presses.
//  effort mismatch  a drive's measured effort, for kMismatch_s, is further from the commanded one
//                   than kTolerance of it and kLeastShare of the joint's largest; both pass one
//                   low-pass, so that neither a drive's delay nor its noise counts.
//
// The figures are a hand's, in newtons, metres a second and kilograms: none is a device's.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/pose.h"
#include "firmware/safety/encoder_guard.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

struct EffortFinding {
  std::uint64_t faults = 0;  // FaultBits
  std::uint32_t joint = 0;   // the joint that has the fault, 1 for the first; 0: none
};

class EffortGuard {
 public:
  void configure(const ControllerConfig& config);

  // Forgets all samples. Call while the motors have no power.
  void rest();

  // Returns the fault found with this sample. The sample must be finite and the pose good; `held`
  // are the efforts commanded by the previous tick, N or N m.
  EffortFinding check(const drivers::JointSample& sample, const Pose& pose,
                      const JointEfforts& held);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  struct Joint {
    double force_N = 0.0;        // smoothed
    double speed_m_per_s = 0.0;  // smoothed
    double growth = 0.0;         // natural logarithm of the growth
    double commanded = 0.0;      // smoothed
    double measured = 0.0;       // smoothed
    double largest = 1.0;        // the joint's largest effort, N or N m
    std::uint32_t wrong_ticks = 0;
  };

  bool is_driven_against(Joint& joint, double force_N, double speed_m_per_s) const;
  bool is_mismatched(Joint& joint, double commanded, double measured) const;

  std::array<Joint, kJointCount> joints_{};
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 0.001;
  double motion_share_ = 1.0;  // low-pass: share of the step to a new value per tick
  double effort_share_ = 1.0;
  std::uint32_t wrong_ticks_to_fault_ = 1;
};

}  // namespace tactus::firmware
