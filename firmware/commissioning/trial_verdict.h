// Judges a joint's trial: whether motor, encoder and their scales agree with device.toml. All are
// pure functions for any thread; not real time.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/commissioning/joint_trial.h"

namespace tactus::firmware {

// The result for one joint. `no_motion` and those after `unclear` are the ends of a trial
// (TrialEnd).
enum class Verdict : std::uint8_t {
  passed,
  reversed,       // the joint moves against its effort
  moves_another,  // the motor moves another joint than its own
  no_motion,
  too_light,       // it answers more strongly than its inertia allows
  too_heavy,       // it answers more weakly than its inertia allows
  torque_differs,  // the drive reports another torque than was commanded
  travel_differs,  // the hand moved it over another range than its limits
  unclear,         // its motion does not fit the pulse: somebody holds the handle
  went_too_far,
  never_still,
  sample_bad,
};
inline constexpr std::size_t kVerdicts = 12;

// The range over which the hand has moved a joint, rad or m.
struct TravelSeen {
  double lower = 0.0;
  double upper = 0.0;
};

// The values of the joint in device.toml.
struct JointExpectation {
  // The apparent inertia at the joint, kg m^2 or kg.
  double inertia = 0.0;
  // The limits of the joint, rad or m.
  double lower = 0.0;
  double upper = 0.0;
  // The range of every joint, rad or m, to judge how far another joint moved.
  std::array<double, drivers::kMaxJoints> range{};
};

// The factor by which the measured inertia, and with it the motor's torque and the encoder's scale,
// may differ from the expected one.
inline constexpr double kInertiaFactor = 2.0;
// The range in which the ratio of reported to commanded torque passes.
inline constexpr double kReportedLow = 0.7;
inline constexpr double kReportedHigh = 1.4;
// The travel by hand must be at least kTravelLow of the joint's range, and must not exceed its ends
// by more than kTravelBeyond of it.
inline constexpr double kTravelLow = 0.15;
inline constexpr double kTravelBeyond = 0.1;
// A fit that explains less than this share is not used.
inline constexpr double kExplained = 0.8;

// Returns the verdict on a trial that has ended. A trial that is still running counts as
// sample_bad. `joint` is the index of the tried joint.
Verdict judge_trial(const JointTrial& trial, std::size_t joint, const JointExpectation& expected);
// Returns `passed` or `travel_differs` for the range over which the hand has moved the joint.
Verdict judge_travel(const TravelSeen& seen, const JointExpectation& expected);

// The texts of a verdict.
struct VerdictText {
  Verdict verdict;
  std::string_view name;    // for programs
  std::string_view what;    // for people, as "moves against its effort"
  std::string_view remedy;  // says what to check
};
// Returns the texts of a verdict, in static storage.
const VerdictText& text_of(Verdict verdict);

}  // namespace tactus::firmware
