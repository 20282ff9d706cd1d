// Checks after every activation, with small pushes, whether each motor moves its joint in the
// commanded direction. Until all have answered, the rendered force stays small.
//
// A push that the controller knows and the hand does not is the only evidence that cannot be
// mistaken for the hand: the motion behind a reversed motor is, without it, that of a hand that
// presses. A pulse on one joint takes the effort
//   +a for T, -a for 2 T, +a for T, three times over, with T = 6 ms,
// which is too fast for the hand's spring and damper: the joint answers with its mass, so
//   q'' = g u(t - d) + h
// with u all of the joint's commanded effort, d the configured delay, g = 1 / mass, below 0 behind
// a reversed motor or encoder, and h all that the hand and friction add. Over the 72 ms of a pulse,
// h moves the joint by a polynomial of time of the fifth degree and little more. With y the
// positions, r the double integral of the effort, and z that of the pulse alone less its polynomial
// (an instrument, as in Soderstrom and Stoica 1983: it knows nothing of the hand),
//   g = (z . y) / (z . r).
// A pulse counts if g r explains more than half of what a cubic leaves of y: where a hand shakes,
// even at 25 Hz, the fourth and fifth degree are most of that. The pulses alternate in sign. A
// delay that is 1 ms longer than said changes no answer.
//
//  right       two pulses in a row with g > 0
//  reversed    three in a row with g < 0: motor_reversed, with the joint's number
//  too strong  three in a row with g more than twice what the device's own mass allows:
//              effort_mismatch, with the joint's number. A mass m at the handle has the mobility
//              (m J^T J)^-1, whose diagonal is each joint's g while the others are free; the hand's
//              own mass can only lessen it. A motor of three times the torque that is said, or an
//              encoder of four times the counts, is found so; one that is too weak feels like a
//              heavy hand, and is for `tactus commission` to find.
//
// A joint that does not answer, because it is held or its friction is larger, is pushed harder, up
// to sign_check_N at the handle, and asked again; the others' turn comes in between. Sizes at the
// handle are effort over L, the length of the joint's column of the Jacobian.
//
// Real time: no heap, at most some 40 multiplications a tick and 200 at the end of a pulse.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/kinematics/pose.h"
#include "firmware/safety/effort_guard.h"
#include "firmware/safety/encoder_guard.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The largest sum of the rendered force and a pulse, N, until all motors have answered.
inline constexpr double kUncheckedForce_N = 2.0;

class MotorSignCheck {
 public:
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

  [[nodiscard]] bool is_done() const { return unanswered_ == 0; }

  // Returns the largest rendered force while the check is not done, N.
  [[nodiscard]] double force_limit_N() const { return kUncheckedForce_N - most_N_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  static constexpr std::size_t kMaxSamples = 80;
  static constexpr std::size_t kPowers = 6;  // powers of time that are projected out
  static constexpr std::size_t kMaxDelay = 7;

  struct Joint {
    double force_N = 0.0;     // next pulse at the handle, with the sign with which it begins
    std::uint32_t right = 0;  // pulses in a row, as the three below
    std::uint32_t wrong = 0;
    std::uint32_t strong = 0;
    std::uint32_t unclear = 0;
  };

  // Sums over the samples of a pulse.
  struct Sums {
    std::array<double, kPowers> y_powers{};
    std::array<double, kPowers> r_powers{};
    double z_y = 0.0;
    double z_r = 0.0;
    double y_y = 0.0;
    double y_r = 0.0;
    double r_r = 0.0;
  };

  void prepare_tables();
  void begin_pulse(const drivers::JointSample& sample, const Pose& pose);
  void take_sample(double position, double mean_effort);
  EffortFinding judge();
  void choose_next();
  [[nodiscard]] double free_gain(const Pose& pose) const;
  [[nodiscard]] double pattern(std::size_t unit) const;

  // These are set by the configuration. A unit is a whole number of ticks, about a millisecond.
  std::size_t joint_count_ = kJointCount;
  std::array<double, kJointCount> max_effort_{};
  double most_N_ = 0.0;
  double moving_mass_kg_ = 0.0;
  double unit_s_ = 0.001;
  std::uint32_t ticks_a_unit_ = 1;
  std::size_t quarter_ = 6;  // units: the T above
  std::size_t delay_ = 0;    // units
  std::size_t samples_ = 0;  // samples of a pulse
  std::uint32_t pause_ticks_ = 0;
  std::array<std::array<double, kPowers>, kMaxSamples> powers_{};  // orthonormal
  std::array<double, kMaxSamples> instrument_{};  // z, of length 1, without the powers

  std::array<Joint, kJointCount> joints_{};
  std::uint32_t unanswered_ = 0;  // a bit for each joint
  std::size_t asked_ = 0;         // the joint whose turn it is
  bool is_pulsing_ = false;
  std::uint32_t ticks_to_wait_ = 0;
  std::uint32_t ticks_ = 0;                      // ticks since the pulse began
  double start_ = 0.0;                           // position at the pulse's start, rad or m
  double effort_sum_ = 0.0;                      // sum over this unit's ticks
  std::array<double, kMaxDelay + 1> efforts_{};  // the last units, by unit modulo the length
  double effort_integral_ = 0.0;
  double effort_double_integral_ = 0.0;
  double amplitude_ = 0.0;  // effort, with sign
  double most_gain_ = 0.0;  // largest gain of the joint in this pose, in units; 0: not known
  Sums sums_;
  JointEfforts push_{};
};

}  // namespace tactus::firmware
