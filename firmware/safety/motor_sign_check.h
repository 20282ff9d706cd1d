// Checks after every activation, with small pushes, whether each motor moves its joint in the
// commanded direction. Until all have answered, the rendered force stays small. One thread; real
// time: no heap, at most some 40 multiplications a tick and 200 at the end of a pulse.
//
// Reason. Without a push of its own the controller cannot tell a reversed motor from a hand that
// presses: both move the tool alike. The hand does not know the push, so the answer to it is not
// the hand's.
//
// Pulse. A pulse on one joint takes the effort
//   +a for T, -a for 2 T, +a for T, three times over, with T = 6 ms.
// That is too fast for the hand's spring and damper: the joint answers with its mass, so
//   q'' = g u(t - d) + h.
// u is all of the joint's commanded effort, d the configured delay, g = 1 / mass, below 0 behind a
// reversed motor or encoder, and h is all that the hand and friction add.
//
// Estimate. Over the 72 ms of a pulse, h moves the joint by a polynomial of time of the fifth
// degree and little more. Let y be the positions, r the double integral of the effort, and z that
// of the pulse alone, less its polynomial. z is an instrument (Soderstrom and Stoica 1983): it
// knows nothing of the hand. Then
//   g = (z . y) / (z . r).
// A pulse counts if g r explains more than half of the motion y that is left after a cubic is
// subtracted. The comparison uses a cubic and not the fifth degree, because a hand that shakes,
// even at 25 Hz, makes mostly motions of the fourth and fifth degree, and they must count against
// the pulse. The pulses alternate in sign. A delay that is 1 ms longer than configured changes no
// answer.
//
// Verdicts, each with the joint's number:
//  - The motor is right after two pulses in a row with g > 0.
//  - motor_reversed: three pulses in a row have g < 0.
//  - effort_mismatch: three pulses in a row have a g more than twice what the device's own mass
//    allows. A mass m at the handle has the mobility (m J^T J)^-1, whose diagonal is each joint's g
//    while the other joints are free; the hand's own mass can only lessen it. This finds a motor of
//    three times the torque that is configured, or an encoder of four times the counts. A motor
//    that is too weak feels like a heavy hand; `tactus commission` finds it.
//
// A joint may not answer because it is held or because its friction is larger than the push. It is
// then pushed harder, up to sign_check_N at the handle, and asked again; the other joints' turn
// comes in between. Sizes at the handle are effort over L, the length of the joint's column of the
// Jacobian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/pose.h"
#include "firmware/safety/effort_guard.h"
#include "firmware/safety/encoder_guard.h"
#include "firmware/safety/sign_pulse.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The largest sum of the rendered force and a pulse, N, until all motors have answered.
inline constexpr double kUncheckedForce_N = 2.0;

// The check of all motors of a mechanism.
class MotorSignCheck {
 public:
  // Takes rate, joints, delay and mass, computes the tables and restarts.
  void configure(const ControllerConfig& config);

  // Checks all joints anew. Call at activation.
  void restart();

  // Takes a finite sample, a good pose and the efforts commanded by the previous tick (N or N m),
  // and chooses push() for this tick. Call once per tick while the motors have power. Returns the
  // fault found, if any.
  EffortFinding step(const drivers::JointSample& sample, const Pose& pose,
                     const JointEfforts& held);

  // Replaces step() for a sample that must not be used, and gives up the present pulse.
  void pass();

  // Returns the pulse's part of this tick's efforts, N or N m. The caller adds it to the others.
  [[nodiscard]] const JointEfforts& push() const { return push_; }

  // Returns true if all motors have answered, or if the check is switched off.
  [[nodiscard]] bool is_done() const { return unanswered_ == 0; }

  // Returns the largest rendered force while the check is not done, N.
  [[nodiscard]] double force_limit_N() const { return kUncheckedForce_N - settings_.most_N; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // The configured values.
  struct Settings {
    std::size_t joint_count = kJointCount;
    std::array<double, kJointCount> max_effort{};
    // The largest push at the handle, N; 0: the check is off.
    double most_N = 0.0;
    // 0: not known.
    double moving_mass_kg = 0.0;
    std::uint32_t pause_ticks = 0;
  };

  // The memory of one joint.
  struct Joint {
    // The next pulse at the handle, N, with the sign with which it begins.
    double force_N = 0.0;
    // The numbers of pulses in a row with each answer.
    std::uint32_t right = 0;
    std::uint32_t wrong = 0;
    std::uint32_t strong = 0;
    std::uint32_t unclear = 0;
  };

  // Starts a pulse on the joint whose turn it is, from this sample.
  void begin_pulse(const drivers::JointSample& sample, const Pose& pose);
  // Judges the pulse that has ended and counts its answer.
  EffortFinding judge();
  void choose_next();
  void pass_turn();
  // Returns the largest g that the joint has without a hand; 0 if the mass is not known.
  [[nodiscard]] double free_gain(const Pose& pose) const;

  Settings settings_;
  PulseShape shape_;
  PulseTables tables_;
  std::array<Joint, kJointCount> joints_{};
  // A bit for each joint that has not answered.
  std::uint32_t unanswered_ = 0;
  // The index of the joint whose turn it is.
  std::size_t asked_ = 0;
  // The number of ticks until the next pulse.
  std::uint32_t ticks_to_wait_ = 0;
  SignPulse pulse_;
  // Twice the largest g that the joint has without a hand in this pose, in units of time; 0: not
  // known.
  double most_gain_ = 0.0;
  JointEfforts push_{};
};

}  // namespace tactus::firmware
