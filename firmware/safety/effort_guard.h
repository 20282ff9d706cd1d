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
//  - effort_mismatch: a drive measures an effort that was not commanded of late. A measurement may
//    be late or smoothed: it then lies between the smallest and the largest effort that the motor
//    held in the last two ticks, device_delay_s and kDriveDelay_s. Its distance from that range
//    passes a low-pass, so that noise does not count. The fault is a distance of more than
//    kTolerance of the commanded effort plus kLeastShare of the joint's largest one, in all
//    measurements of kMismatch_s and in at least two. A drive may measure as seldom as it likes.
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

  // Takes the efforts of a tick without a sample that may be used, in place of check().
  void pass(const JointEfforts& held);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // The smallest and the largest of some efforts, N or N m.
  struct Range {
    double least = 0.0;
    double most = 0.0;
  };

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
    // The efforts held since the present span of ticks began, and those of the span before.
    Range held_now;
    Range held_before;
    // The distance of the measured effort from those that were held, N or N m, smoothed.
    double distance = 0.0;
    // The joint's largest effort, N or N m.
    double largest = 1.0;
    // The number of ticks since the last measurement, this one included.
    std::uint32_t unmeasured_ticks = 0;
    // The number of ticks since the first of the measurements in a row that were too far off, that
    // one included; 0 if the last was not.
    std::uint32_t wrong_ticks = 0;
  };

  // Takes the joint's effort and speed at the tool. Returns true if its motor is reversed.
  bool is_driven_against(Joint& joint, double force_N, double speed_m_per_s) const;
  // Takes the effort that the joint's drive has measured, N or N m, after pass(). Returns true if
  // it and those before it have been too far off for long enough.
  bool is_mismatched(Joint& joint, double held, double measured) const;

  std::array<Joint, kJointCount> joints_{};
  std::size_t joint_count_ = kJointCount;
  double step_s_ = 0.001;
  // The low-pass of force and speed: the share of the step to a new value in a tick.
  double motion_share_ = 1.0;
  // The same of the commanded efforts.
  double effort_share_ = 1.0;
  std::uint32_t wrong_ticks_to_fault_ = 1;
  // A measurement shows an effort of these last ticks. The spans of held efforts are as long, so
  // that two of them hold all these ticks.
  std::uint32_t late_ticks_ = 1;
  // The number of ticks in the present span.
  std::uint32_t span_ticks_ = 0;
};

}  // namespace tactus::firmware
