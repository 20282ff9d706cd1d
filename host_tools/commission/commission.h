// The guided check of a device: does every joint answer its motor as device.toml says?
//
// In order: homing; the hand moves the handle everywhere, without motor power; then, with the
// handle free, gentle pulses on one joint after the other (firmware/commissioning). The motors'
// power goes off between joints and at every end, also by an exception.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/commissioning/trial_verdict.h"
#include "firmware/device_file/device_config.h"
#include "host_tools/commission/bench.h"

namespace tactus::host {

struct CommissionPlan {
  const firmware::ControllerConfig& controller;
  std::vector<std::string> joints;  // their names
  // The device's mass as felt at the handle, kg: it gives each joint's expected inertia.
  double moving_mass_kg = 0.0;
  // The first and the strongest pulse, as shares of a joint's largest effort.
  double first_effort_share = 0.02;
  double most_effort_share = 0.5;
  double homing_limit_s = 120.0;
};

struct JointReport {
  std::string name;
  firmware::Verdict verdict = firmware::Verdict::sample_bad;
  firmware::PulseFit fit;
  double effort = 0.0;  // of the pulse that was measured
  double expected_inertia = 0.0;
  firmware::TravelSeen travel;
  double lower = 0.0;
  double upper = 0.0;
  bool slides = false;
};

struct CommissionReport {
  std::vector<JointReport> joints;
  std::string trouble;          // of the device, if that ended it
  double moving_mass_kg = 0.0;  // of the plan
  [[nodiscard]] bool has_passed() const;
};

// Told at the start of each step: "shoulder: pulses of 0.04 N m".
using CommissionProgress = std::function<void(std::string_view step)>;

// Throws InputError if the device does not come up or is not homed in time.
CommissionReport commission(Bench& bench, const CommissionPlan& plan,
                            const CommissionProgress& progress = {});

// The inertia that each joint feels of a mass at the handle while the other joints are free, kg m^2
// or kg, at these joints: 1 / ((m J^T J)^-1)_ii.
std::array<double, firmware::kJointCount> apparent_inertia(const firmware::ControllerConfig& config,
                                                           const drivers::JointSample& sample,
                                                           double mass_kg);

}  // namespace tactus::host
