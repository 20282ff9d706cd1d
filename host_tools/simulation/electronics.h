// The parts between a joint and the controller's numbers: an encoder with its velocity estimate,
// and a motor.
#pragma once

#include <cstdint>

namespace tactus::host {

// A quadrature encoder and the filtered difference that a device's firmware makes of it.
class Encoder {
 public:
  // counts of `resolution` (rad or m each); the velocity passes a first-order low-pass of the given
  // cut-off.
  Encoder(double resolution, double velocity_cutoff_Hz, double tick_s);

  // Takes the joint's true position once a tick; `position` is then within half a count of it.
  void sample(double true_position);
  // The next sample sets the position without a velocity: after power-up and where homing moves the
  // origin.
  void restart() { fresh_ = true; }

  [[nodiscard]] std::int64_t counts() const { return counts_; }
  [[nodiscard]] double position() const { return static_cast<double>(counts_) * resolution_; }
  [[nodiscard]] double velocity() const { return velocity_; }

 private:
  double resolution_;
  double filter_gain_;
  double tick_s_;
  std::int64_t counts_ = 0;
  double velocity_ = 0.0;
  bool fresh_ = true;
};

// A motor with its amplifier: the effort follows the clamped command with one time constant.
class Motor {
 public:
  Motor(double effort_limit, double time_constant_s, double step_s);

  // Newest command, N m or N; not finite counts as zero.
  void command(double effort);
  // One step; the effort in force at its end, exact for a command held over the step.
  double advance();
  [[nodiscard]] double effort() const { return effort_; }

 private:
  double limit_;
  double gain_;
  double target_ = 0.0;
  double effort_ = 0.0;
};

}  // namespace tactus::host
