// What a joint's trial means: whether motor, encoder and their scales are what device.toml says.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/commissioning/joint_trial.h"

namespace tactus::firmware {

enum class Verdict : std::uint8_t {
  passed,
  reversed,       // the joint moves against its effort
  moves_another,  // the motor moves another joint than its own
  no_motion,
  too_light,       // it answers more strongly than its inertia allows
  too_heavy,       // it answers more weakly
  torque_differs,  // the drive reports another torque than was commanded
  travel_differs,  // the hand moved it over another range than its limits
  unclear,         // what it did is no answer to the pulse: somebody holds the handle
  went_too_far,
  never_still,
  sample_bad,
};
inline constexpr std::size_t kVerdicts = 12;

// What the hand has moved a joint over, rad or m.
struct TravelSeen {
  double lower = 0.0;
  double upper = 0.0;
};

// What device.toml says of the joint.
struct JointExpectation {
  double inertia = 0.0;  // apparent, kg m^2 or kg
  double lower = 0.0;    // its limits
  double upper = 0.0;
  // The range of every joint, to tell how far another one went.
  std::array<double, drivers::kMaxJoints> range{};
};

// The factor by which the measured inertia, and with it the motor's torque and the encoder's scale,
// may differ from the expected one.
inline constexpr double kInertiaFactor = 2.0;
// The reported torque over the commanded one.
inline constexpr double kReportedLow = 0.7;
inline constexpr double kReportedHigh = 1.4;
// The travel by hand: at least this share of the joint's range, and not beyond its ends by more
// than this share of it.
inline constexpr double kTravelLow = 0.15;
inline constexpr double kTravelBeyond = 0.1;
// A fit that explains less than this is none.
inline constexpr double kExplained = 0.8;

Verdict judge_trial(const JointTrial& trial, std::size_t joint, const JointExpectation& expected);
Verdict judge_travel(const TravelSeen& seen, const JointExpectation& expected);

// For people: "moves against its effort" and what to check.
struct VerdictText {
  Verdict verdict;
  std::string_view name;  // for programs
  std::string_view what;
  std::string_view remedy;
};
const VerdictText& text_of(Verdict verdict);

}  // namespace tactus::firmware
