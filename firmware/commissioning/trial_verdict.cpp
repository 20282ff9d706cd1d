#include "firmware/commissioning/trial_verdict.h"

#include <array>
#include <cmath>

namespace tactus::firmware {
namespace {

constexpr std::array<VerdictText, kVerdicts> kTexts = {{
    {Verdict::passed, "passed", "answers as it should", ""},
    {Verdict::reversed, "reversed", "moves against its effort",
     "swap two of the motor's wires or change motor_direction; if the handle's motion is shown the "
     "wrong way round, change encoder_direction"},
    {Verdict::moves_another, "moves_another", "stands still while another joint moves",
     "the motors of two joints are exchanged: check the axes' node numbers and the cables"},
    {Verdict::no_motion, "no_motion", "does not move under the strongest gentle pulse",
     "check the motor's cable, a brake, the drive's current limit, and that nobody holds it"},
    {Verdict::too_light, "too_light", "answers more strongly than its inertia allows",
     "check the torque constant, motor_ratio, encoder_ratio and counts per turn; if the device is "
     "that light, set [plant] moving_mass_kg"},
    {Verdict::too_heavy, "too_heavy", "answers more weakly than its inertia says",
     "check the torque constant, motor_ratio, encoder_ratio and counts per turn; if the device is "
     "that heavy, set [plant] moving_mass_kg"},
    {Verdict::torque_differs, "torque_differs", "has a drive that reports another torque",
     "check the drive's torque constant and current limit"},
    {Verdict::travel_differs, "travel_differs", "was moved over another range than its limits",
     "move it from end to end; check encoder_ratio, counts per turn, the reference's position and "
     "the joint's lower and upper"},
    {Verdict::unclear, "unclear", "does not answer the pulses alone",
     "let go of the handle, keep the table still and try again"},
    {Verdict::went_too_far, "went_too_far", "went farther than a gentle pulse may move it",
     "check the torque constant and motor_ratio"},
    {Verdict::never_still, "never_still", "does not come to rest",
     "let go of the handle; support an arm that sinks, so that it hangs at rest"},
    {Verdict::sample_bad, "sample_bad", "has a device in trouble", "see the device's own message"},
}};

// The motor moves another joint if that one moves this many times as far, each measured as a share
// of its range.
constexpr double kMuchFarther = 4.0;

// Returns true if another joint moved much farther than the tried one.
bool another_moved(const JointTrial& trial, std::size_t joint, const JointExpectation& expected) {
  const auto share = [&](std::size_t i) {
    return expected.range[i] > 0.0 ? trial.travel()[i] / expected.range[i] : 0.0;
  };
  // A smaller share of the range is noise, or the table moves.
  constexpr double kSeen = 1e-3;
  for (std::size_t i = 0; i < drivers::kMaxJoints; ++i) {
    if (i != joint && share(i) > kSeen && share(i) > kMuchFarther * share(joint)) {
      return true;
    }
  }
  return false;
}

// Judges a measured pulse. The order matters: a fit that explains little says nothing about the
// sign, and the sign nothing about the scale.
Verdict judge_fit(const PulseFit& fit, const JointExpectation& expected) {
  if (fit.explained < kExplained) {
    return Verdict::unclear;
  }
  if (fit.inertia < 0.0) {
    return Verdict::reversed;
  }
  if (fit.reported_share != 0.0 &&
      (fit.reported_share < kReportedLow || fit.reported_share > kReportedHigh)) {
    return Verdict::torque_differs;
  }
  if (fit.inertia * kInertiaFactor < expected.inertia) {
    return Verdict::too_light;
  }
  return fit.inertia > kInertiaFactor * expected.inertia ? Verdict::too_heavy : Verdict::passed;
}

}  // namespace

Verdict judge_trial(const JointTrial& trial, std::size_t joint, const JointExpectation& expected) {
  switch (trial.end()) {
    case TrialEnd::measured:
      return another_moved(trial, joint, expected) ? Verdict::moves_another
                                                   : judge_fit(trial.fit(), expected);
    case TrialEnd::no_motion:
      return another_moved(trial, joint, expected) ? Verdict::moves_another : Verdict::no_motion;
    case TrialEnd::went_too_far:
      return trial.fit().inertia < 0.0 ? Verdict::reversed : Verdict::went_too_far;
    case TrialEnd::never_still:
      return Verdict::never_still;
    case TrialEnd::running:
    case TrialEnd::sample_bad:
      break;
  }
  return Verdict::sample_bad;
}

Verdict judge_travel(const TravelSeen& seen, const JointExpectation& expected) {
  const double range = expected.upper - expected.lower;
  const double beyond = kTravelBeyond * range;
  const bool is_far_enough = seen.upper - seen.lower >= kTravelLow * range;
  const bool is_inside =
      seen.lower >= expected.lower - beyond && seen.upper <= expected.upper + beyond;
  return is_far_enough && is_inside ? Verdict::passed : Verdict::travel_differs;
}

const VerdictText& text_of(Verdict verdict) {
  return kTexts[static_cast<std::size_t>(verdict)];
}

}  // namespace tactus::firmware
