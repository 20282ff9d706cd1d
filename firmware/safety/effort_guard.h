// Finds motors that push the wrong way, or with another effort than commanded. One thread; real
// time.
//
// Reversed motors. Joint i moves the tool by L_i metres for each unit of its own motion; L_i is the
// length of column i of the Jacobian. At the tool its effort is f = tau / L and its speed u = q' L,
// and
//   M du/dt = k f + h
// with the mass M of device and hand, the hand's own push h, and k = 1 for a joint that is wired
// right, -1 for one that is reversed. A surface makes f grow with the depth. Behind a reversed
// motor, speed and effort therefore drive each other: both grow by the same power of e, and M du/dt
// keeps up with f. A hand that presses drives the speed alone. To look the same it has to push
// twice as hard as the surface, and its push has to grow as fast. So both growths are summed while
//   f > kLeast_N, u > kLeast_m_per_s against f, both rising, and M |du/dt| > kShare f.
//
// The two faults:
//  - motor_reversed: the smaller growth passes kGrowth. The effort and the speed against it have
//    then both become e^kGrowth times as large. This needs motion: a firm hand that yields slowly
//    to a reversed motor looks like one that presses.
//  - effort_mismatch: a drive's measured effort differs from the commanded one by more than
//    kTolerance of it plus kLeastShare of the joint's largest effort, for kMismatch_s. Both pass
//    the same low-pass, so that neither a drive's delay nor its noise counts.
//
// The constants are a hand's, in newtons, metres a second and kilograms: none is a device's.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/pose.h"
#include "firmware/safety/encoder_guard.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The result of a check of the motors.
struct EffortFinding {
  // FaultBits.
  std::uint64_t faults = 0;
  // The joint that has the fault, 1 for the first; 0: none.
  std::uint32_t joint = 0;
};

// The guard of all joints of a mechanism.
class EffortGuard {
 public:
  // Takes rate, joints and limits, and forgets all samples.
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
  // The memory of one joint. Smoothed values are low-passed.
  struct Joint {
    // The effort at the tool, N, smoothed.
    double force_N = 0.0;
    // The joint's speed at the tool, m/s, smoothed.
    double speed_m_per_s = 0.0;
    // The natural logarithm of the growth so far.
    double growth = 0.0;
    // The commanded effort, N or N m, smoothed.
    double commanded = 0.0;
    // The effort that the drive measured, N or N m, smoothed.
    double measured = 0.0;
    // The joint's largest effort, N or N m.
    double largest = 1.0;
    // The number of ticks in a row with a mismatch.
    std::uint32_t wrong_ticks = 0;
  };

  // Takes the joint's effort and speed at the tool. Returns true if its motor is reversed.
  bool is_driven_against(Joint& joint, double force_N, double speed_m_per_s) const;
  // Takes the joint's efforts, N or N m. Returns true if they have differed for long enough.
  bool is_mismatched(Joint& joint, double commanded, double measured) const;

  std::array<Joint, kJointCount> joints_{};
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 0.001;
  // The low-pass of force and speed: the share of the step to a new value in a tick.
  double motion_share_ = 1.0;
  // The same of the efforts.
  double effort_share_ = 1.0;
  std::uint32_t wrong_ticks_to_fault_ = 1;
};

}  // namespace tactus::firmware
