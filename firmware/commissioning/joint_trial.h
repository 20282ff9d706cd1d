// Tries one joint with gentle pulses of effort, from rest. Each pulse is stronger than the one
// before, until the joint moves far enough to be measured.
//
// A pulse pushes to one side for a quarter of its length, to the other side for two quarters, and
// to the first side again; then the same is mirrored. A free joint therefore ends where it began.
// There is no feedback, so that a reversed motor cannot run away. The effort ends at once if the
// joint leaves `largest_travel`, if a sample reports trouble, or at the time limit.
//
// Positions are in rad and efforts in N m for a revolute joint; m and N for a prismatic one. One
// thread. Call tick() once per tick; it is real time and uses no heap.
#pragma once

#include <cstdint>

#include "drivers/device.h"
#include "firmware/commissioning/pulse_fit.h"

namespace tactus::firmware {

// The joint and the strength of its pulses.
struct TrialConfig {
  // The index of the joint; 0 is the first.
  std::size_t joint = 0;
  double rate_hz = 1000.0;
  // The effort of the first pulse. Each next one is 1.6 times as large.
  double first_effort = 0.0;
  // The largest effort of a pulse.
  double most_effort = 0.0;
  // A pulse that moves the joint this far, and by 25 encoder counts, is measured.
  double wanted_travel = 0.0;
  // The trial ends beyond this distance from the pulse's start.
  double largest_travel = 0.0;
};

// The end of a trial, or `running`.
enum class TrialEnd : std::uint8_t {
  running,
  measured,      // a pulse moved the joint far enough, well above friction; see fit()
  no_motion,     // even the strongest pulse moved it less than wanted
  went_too_far,  // it moved beyond largest_travel
  never_still,   // the handle was held, or the arm sinks
  sample_bad,    // the device reported trouble, or a number is not finite
};

// The trial of one joint. Make a new object for each trial.
class JointTrial {
 public:
  explicit JointTrial(const TrialConfig& config) : config_(config) {}

  // Takes the newest sample and returns the effort of this joint until the next one; 0 after the
  // trial has ended.
  double tick(const drivers::JointSample& sample);

  // Returns `running` until the trial has ended.
  [[nodiscard]] TrialEnd end() const { return end_; }
  // Returns the fit of the last pulse; all zeros before one has ended.
  [[nodiscard]] const PulseFit& fit() const { return fit_; }
  // Returns the effort of the last pulse, N m or N.
  [[nodiscard]] double effort() const { return effort_; }
  // Returns how far each joint moved from its place at the last pulse's start, rad or m. It shows a
  // motor that moves another joint.
  [[nodiscard]] const std::array<double, drivers::kMaxJoints>& travel() const { return travel_; }

 private:
  enum class Phase : std::uint8_t { settling, pulsing };

  // Waits for the joint to rest. Returns 0, or the first effort of the next pulse.
  double settle(const drivers::JointSample& sample);
  // Records the sample and returns the effort for the next one.
  double pulse(const drivers::JointSample& sample);
  // Fits the record and decides: measured, another pulse, or no motion.
  void judge();
  // Returns the sign of the effort at sample k of a pulse: 1, -1 or 0.
  [[nodiscard]] double pattern(std::size_t k) const;
  // Returns the number of samples of a pulse with its mirror image and rest.
  [[nodiscard]] std::size_t samples() const;

  TrialConfig config_;
  Phase phase_ = Phase::settling;
  TrialEnd end_ = TrialEnd::running;
  double effort_ = 0.0;
  // The sample at the start of the pulse, or of the present rest.
  drivers::JointSample start_;
  std::uint32_t still_ticks_ = 0;
  std::uint32_t settling_ticks_ = 0;
  PulseRecord record_;
  PulseFit fit_;
  std::array<double, drivers::kMaxJoints> travel_{};
};

}  // namespace tactus::firmware
