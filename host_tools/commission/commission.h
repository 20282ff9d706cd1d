// The guided check of a device before its first force: does every joint answer its motor as
// device.toml says? `tactus commission` runs it.
//
// The steps are: homing; the person moves the handle everywhere while the motors have no power;
// then, with the handle free, gentle pulses on one joint after the other (firmware/commissioning).
// The motors' power goes off between joints and at every end, an exception included.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/commissioning/trial_verdict.h"
#include "firmware/device_file/device_config.h"
#include "host_tools/commission/bench.h"

namespace tactus::host {

// The checks to make, and their strength.
struct CommissionPlan {
  // Mechanism, limits and rate of the device; it must outlive the plan.
  const firmware::ControllerConfig& controller;
  // The joints' names, for the report.
  std::vector<std::string> joints;
  // The device's mass as felt at the handle, from which each joint's expected inertia follows.
  double moving_mass_kg = 0.0;
  // The first and the strongest pulse, as shares of the joint's largest effort.
  double first_effort_share = 0.02;
  double most_effort_share = 0.5;
  // The time after which homing counts as failed.
  double homing_limit_s = 120.0;
};

// The behaviour of one joint. Units are those of the joint: rad, N m, kg m^2, or m, N, kg if it
// slides.
struct JointReport {
  std::string name;
  // The joint's verdict: passed, or the first fault that was found.
  firmware::Verdict verdict = firmware::Verdict::sample_bad;
  // The joint's inertia, friction and delay as the pulse showed them.
  firmware::PulseFit fit;
  // The effort of the pulse that was measured.
  double effort = 0.0;
  // The inertia that follows from the mass at the handle.
  double expected_inertia = 0.0;
  // The smallest and largest position while the person moved the handle.
  firmware::TravelSeen travel;
  // The joint's limits in device.toml.
  double lower = 0.0;
  double upper = 0.0;
  // True for a linear joint.
  bool slides = false;
};

// The result for all joints.
struct CommissionReport {
  std::vector<JointReport> joints;
  // The device's own words, if a fault of the device ended the check.
  std::string trouble;
  // The mass of the plan.
  double moving_mass_kg = 0.0;
  // Returns true if all joints passed and the device had no fault.
  [[nodiscard]] bool has_passed() const;
};

// Receives a text at the start of each step, such as "shoulder: pulses of 0.04 N m".
using CommissionProgress = std::function<void(std::string_view step)>;

// Runs the check. Throws InputError if the device does not come up or is not homed in time.
CommissionReport commission(Bench& bench, const CommissionPlan& plan,
                            const CommissionProgress& progress = {});

// Returns the inertia that each joint feels of a mass at the handle while the other joints are
// free, kg m^2 or kg: the inverse of the diagonal of (m J^T J)^-1, at the joints of `sample`.
std::array<double, firmware::kJointCount> apparent_inertia(const firmware::ControllerConfig& config,
                                                           const drivers::JointSample& sample,
                                                           double mass_kg);

}  // namespace tactus::host
