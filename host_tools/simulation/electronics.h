// The electronics between a joint of the simulated device and the numbers of the controller: an
// encoder with its velocity estimate, and a motor with its amplifier. SimulatedDevice owns one of
// each a joint.
#pragma once

#include <cstdint>

namespace tactus::host {

// A quadrature encoder, and the filtered difference of its counts that the firmware of a drive
// reports as velocity.
class Encoder {
 public:
  // `resolution` is the size of a count, rad or m; `velocity_cutoff_Hz` the cut-off of the
  // velocity's first-order low-pass (infinite: no filter); `tick_s` the time between samples.
  Encoder(double resolution, double velocity_cutoff_Hz, double tick_s);

  // Reads the joint's true position, rad or m, once a tick. The reported position is then the
  // nearest whole count.
  void sample(double true_position);
  // Makes the next sample set the position without a velocity: after power-up, and when homing
  // moves the origin, where the difference of two samples means nothing.
  void restart() { fresh_ = true; }

  // Returns the counts of the last sample.
  [[nodiscard]] std::int64_t counts() const { return counts_; }
  // Returns the position of the last sample, rad or m: a whole number of counts.
  [[nodiscard]] double position() const { return static_cast<double>(counts_) * resolution_; }
  // Returns the filtered velocity, rad/s or m/s.
  [[nodiscard]] double velocity() const { return velocity_; }

 private:
  double resolution_;
  double filter_gain_;
  double tick_s_;
  std::int64_t counts_ = 0;
  double velocity_ = 0.0;
  bool fresh_ = true;
};

// A motor with its amplifier: the effort (torque, or force of a linear joint) follows the clamped
// command as a first-order system.
class Motor {
 public:
  // `effort_limit` in N m or N; `step_s` is the time between two calls of advance().
  Motor(double effort_limit, double time_constant_s, double step_s);

  // Sets the commanded effort, N m or N, clamped to the limit. A command that is not finite counts
  // as 0.
  void command(double effort);
  // Advances by one step and returns the effort at its end, N m or N. The result is exact for a
  // command that is constant over the step.
  double advance();
  // Returns the effort now, N m or N.
  [[nodiscard]] double effort() const { return effort_; }

 private:
  double limit_;
  double gain_;
  double target_ = 0.0;
  double effort_ = 0.0;
};

}  // namespace tactus::host
