// Tries one joint with gentle pulses of effort, from rest. Each pulse is stronger, until the joint
// moves far enough to be measured.
//
// A pulse pushes one way, twice as long the other way, and back; then the same mirrored. So a free
// joint ends where it began. There is no feedback, so that a reversed motor cannot run away. The
// effort ends at once if the joint leaves `largest_travel`, if a sample reports trouble, or at the
// time limit.
//
// Call it once per tick; it is real time and uses no heap.
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/commissioning/pulse_fit.h"

namespace tactus::firmware {

// Positions are in rad and efforts in N m for a revolute joint; m and N for a prismatic one.
struct TrialConfig {
  std::size_t joint = 0;
  double rate_hz = 1000.0;
  double first_effort = 0.0;    // effort of the first pulse; each next one is 1.6 times as large
  double most_effort = 0.0;     // largest effort
  double wanted_travel = 0.0;   // a pulse that moves this far, and 25 encoder counts, is measured
  double largest_travel = 0.0;  // the trial ends beyond this distance from the pulse's start
};

enum class TrialEnd : std::uint8_t {
  running,
  measured,      // a pulse moved the joint far enough, well above friction; see fit()
  no_motion,     // even the strongest pulse moved it less than wanted
  went_too_far,  // it moved beyond largest_travel
  never_still,   // the handle was held, or the arm sinks
  sample_bad,    // the device reported trouble, or a number is not finite
};

class JointTrial {
 public:
  explicit JointTrial(const TrialConfig& config) : config_(config) {}

  // Takes the newest sample and returns the effort of this joint until the next one; 0 after the
  // trial has ended.
  double tick(const drivers::JointSample& sample);

  [[nodiscard]] TrialEnd end() const { return end_; }
  // Return the fit and the effort of the last pulse.
  [[nodiscard]] const PulseFit& fit() const { return fit_; }
  [[nodiscard]] double effort() const { return effort_; }
  // Returns how far each joint moved in the last pulse, to find a motor that moves another joint.
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
