#include "host_tools/simulation/electronics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/geometry/portable_math.h"

namespace tactus::host {
namespace {

// Returns the share of the distance to a constant target that a first-order system covers in dt: 1
// - exp(-dt / time constant).
double share_covered(double dt_s, double time_constant_s) {
  return time_constant_s > 0.0 ? 1.0 - rendering::exponential(-dt_s / time_constant_s) : 1.0;
}

// Returns the value after one step of a first-order system. Below 1e-15, far under one count or any
// effort that can be felt, it jumps to the target: an endless decay would end in denormal numbers,
// which processors compute with a hundred times slower.
double approach(double value, double target, double share) {
  constexpr double kArrived = 1e-15;
  const double rest = target - value;
  return std::abs(rest) < kArrived ? target : value + share * rest;
}

}  // namespace

Encoder::Encoder(double resolution, double velocity_cutoff_Hz, double tick_s)
    : resolution_(resolution),
      filter_gain_(share_covered(tick_s, 1.0 / (2.0 * std::numbers::pi * velocity_cutoff_Hz))),
      tick_s_(tick_s) {}

void Encoder::sample(double true_position) {
  // std::floor(x + 0.5) instead of std::round: both sides of zero round alike.
  const auto counts = static_cast<std::int64_t>(std::floor(true_position / resolution_ + 0.5));
  if (fresh_) {
    velocity_ = 0.0;
    fresh_ = false;
  } else {
    const double difference = static_cast<double>(counts - counts_) * resolution_ / tick_s_;
    velocity_ = approach(velocity_, difference, filter_gain_);
  }
  counts_ = counts;
}

Motor::Motor(double effort_limit, double time_constant_s, double step_s)
    : limit_(effort_limit), gain_(share_covered(step_s, time_constant_s)) {}

double Motor::advance() {
  effort_ = approach(effort_, target_, gain_);
  return effort_;
}

void Motor::command(double effort) {
  target_ = std::isfinite(effort) ? std::clamp(effort, -limit_, limit_) : 0.0;
}

}  // namespace tactus::host
