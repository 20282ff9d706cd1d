// First-order low-pass of a velocity, by backward Euler, which is stable for every cutoff:
//   y += a (x - y),   a = 2 pi f T / (1 + 2 pi f T).
#pragma once

#include <numbers>

#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The filter of one vector. One thread; real time.
class VelocityFilter {
 public:
  // Sets the cutoff, Hz, and clears the state. A cutoff of 0 switches the filter off.
  void configure(double cutoff_hz, double rate_hz) {
    retune(cutoff_hz, rate_hz);
    state_.setZero();
  }

  // Sets the cutoff and keeps the state.
  void retune(double cutoff_hz, double rate_hz) {
    const double w = 2.0 * std::numbers::pi * cutoff_hz / rate_hz;
    share_ = cutoff_hz > 0.0 ? w / (1.0 + w) : 1.0;
  }

  // Clears the state to rest.
  void reset() { state_.setZero(); }

  // Takes the velocity of this tick and returns the filtered one. Call once per tick.
  Vec3 filter(const Vec3& velocity) {
    state_ += share_ * (velocity - state_);
    return state_;
  }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double share_ = 1.0;
  Vec3 state_ = Vec3::Zero();
};

}  // namespace tactus::firmware
