// Friction of one joint: a model of rendering/friction without a normal force, so that its levels
// are N and N s/m, or N m and N m s/rad where the joint turns.
#pragma once

#include "rendering/friction/friction_model.h"

namespace tactus::host {

class JointFriction {
 public:
  explicit JointFriction(const rendering::FrictionParameters& parameters)
      : parameters_(parameters) {}

  // Moves by velocity dt_s; returns the friction force that opposes the motion (same sign as the
  // velocity when sliding).
  double advance(double velocity, double dt_s) {
    return rendering::update_friction(parameters_, memory_, velocity * dt_s,
                                      rendering::kNoNormalForce_N, dt_s)
        .force_N;
  }

  void release() { memory_ = {}; }
  // J: what the bristles would give back.
  [[nodiscard]] double stored_energy_J() const { return rendering::stored_J(parameters_, memory_); }

 private:
  rendering::FrictionParameters parameters_;
  rendering::FrictionMemory<double> memory_;
};

}  // namespace tactus::host
