// One joint's trial: gentle pulses of effort on it alone, from rest, stronger until it moves enough
// to be measured.
//
// A pulse pushes one way, twice as long the other way and back, then the same mirrored, so that a
// free joint ends where it began. Nothing is fed back: a reversed motor cannot run away with it.
// The effort ends at once if the joint leaves `largest_travel`, if a sample is not well, or at the
// time limit.
//
// One call a tick; no heap, real time.
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/commissioning/pulse_fit.h"

namespace tactus::firmware {

// Of the joint, in rad and N m where it turns, in m and N where it slides.
struct TrialConfig {
  std::size_t joint = 0;
  double rate_hz = 1000.0;
  double first_effort = 0.0;   // of the first pulse; each is 1.6 times the one before
  double most_effort = 0.0;    // never more
  double wanted_travel = 0.0;  // enough to be measured, or 25 counts of the encoder if that is more
  double largest_travel = 0.0;  // from where the pulse began: beyond it the trial ends
};

enum class TrialEnd : std::uint8_t {
  running,
  measured,      // the fit is of a pulse that moved the joint far enough, well above friction
  no_motion,     // even the strongest pulse moved it less than wanted
  went_too_far,  // beyond largest_travel
  never_still,   // the handle was held, or the arm sinks
  sample_bad,    // the device reported trouble, or a number is not finite
};

class JointTrial {
 public:
  explicit JointTrial(const TrialConfig& config) : config_(config) {}

  // The newest sample; returns the effort of this joint until the next. 0 once it has ended.
  double tick(const drivers::JointSample& sample);

  [[nodiscard]] TrialEnd end() const { return end_; }
  // Of the last pulse.
  [[nodiscard]] const PulseFit& fit() const { return fit_; }
  [[nodiscard]] double effort() const { return effort_; }
  // How far each joint went in the last pulse, for motors that move another joint than theirs.
  [[nodiscard]] const std::array<double, drivers::kMaxJoints>& travel() const { return travel_; }

 private:
  enum class Phase : std::uint8_t { settling, pulsing };

  double settle(const drivers::JointSample& sample);
  double pulse(const drivers::JointSample& sample);
  void judge();
  [[nodiscard]] double pattern(std::size_t k) const;
  [[nodiscard]] std::size_t samples() const;

  TrialConfig config_;
  Phase phase_ = Phase::settling;
  TrialEnd end_ = TrialEnd::running;
  double effort_ = 0.0;
  drivers::JointSample start_;
  std::uint32_t still_ticks_ = 0;
  std::uint32_t settling_ticks_ = 0;
  PulseRecord record_;
  PulseFit fit_;
  std::array<double, drivers::kMaxJoints> travel_{};
};

}  // namespace tactus::firmware
