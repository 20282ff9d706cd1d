// The friction of one joint of the simulated device.
#pragma once

#include "rendering/friction/friction_model.h"

namespace tactus::host {

// Uses a friction model of rendering/friction without a normal force, so that the model's levels
// are efforts: N and N s/m for a linear joint, N m and N m s/rad for one that turns.
class JointFriction {
 public:
  explicit JointFriction(const rendering::FrictionParameters& parameters)
      : parameters_(parameters) {}

  // Moves the joint for `dt_s` at `velocity` (rad/s or m/s). Returns the friction effort, which
  // opposes the motion and has the sign of the velocity when the joint slides.
  double advance(double velocity, double dt_s) {
    return rendering::update_friction(parameters_, memory_, velocity * dt_s,
                                      rendering::kNoNormalForce_N, dt_s)
        .force_N;
  }

  // Relaxes the bristles, as after a new placement of the device.
  void release() { memory_ = {}; }
  // Returns the elastic energy of the bristles, J.
  [[nodiscard]] double stored_energy_J() const { return rendering::stored_J(parameters_, memory_); }

 private:
  rendering::FrictionParameters parameters_;
  rendering::FrictionMemory<double> memory_;
};

}  // namespace tactus::host
