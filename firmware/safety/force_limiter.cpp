#include "firmware/safety/force_limiter.h"

#include <algorithm>
#include <cmath>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// Returns the vector with the length `limit`. It divides by the length first, so that 1e300 N does
// not overflow.
Vec3 shortened(const Vec3& v, double length, double limit) {
  return v / length * limit;
}

}  // namespace

double gain_per_tick(double duration_s, double rate_hz) {
  const double ticks = duration_s * rate_hz;
  return ticks > 1.0 ? 1.0 / ticks : 1.0;
}

double length_of(const Vec3& v) {
  // The coordinates are scaled before they are squared, so that no square overflows.
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0.0 ? largest * (v / largest).norm() : 0.0;
}

void ForceLimiter::configure(const ControllerConfig& config) {
  retune(config);
  restart();
}

void ForceLimiter::retune(const ControllerConfig& config) {
  wanted_max_force_N_ = config.safety.max_force_N;
  // A raised limit comes in over soft_start_s; a lowered one has already acted in retune() or
  // hold_below().
  max_force_N_ = std::min(max_force_N_, wanted_max_force_N_);
  max_step_N_ = config.safety.force_slew_N_per_s / config.rate_hz;
  activation_gain_per_tick_ = gain_per_tick(config.safety.soft_start_s, config.rate_hz);
  contact_gain_per_tick_ = gain_per_tick(config.safety.contact_start_s, config.rate_hz);
}

void ForceLimiter::restart() {
  activation_gain_ = 0.0;
  contact_gain_ = 0.0;
  touched_ = false;
  max_force_N_ = wanted_max_force_N_;
  last_W_.setZero();
}

LimitedForce ForceLimiter::soften(const Vec3& force_W, const Vec3& effect_W, bool in_contact) {
  LimitedForce out;
  touched_ = touched_ || in_contact;
  const bool is_rising = activation_gain_ * contact_gain_ < 1.0;
  const bool has_effect = effect_W != Vec3::Zero();
  if (has_effect && contact_gain_ < 1.0) {
    const Vec3 surface_W = force_W - effect_W;
    out.force_W = surface_W * activation_gain_ * contact_gain_ + effect_W * activation_gain_;
  } else {
    out.force_W = force_W * activation_gain_ * contact_gain_;
  }
  if ((in_contact && is_rising) || (has_effect && activation_gain_ < 1.0)) {
    out.limits |= kLimitSoftStart;
  }
  activation_gain_ = std::min(1.0, activation_gain_ + activation_gain_per_tick_);
  if (touched_) {
    contact_gain_ = std::min(1.0, contact_gain_ + contact_gain_per_tick_);
  }
  return out;
}

LimitedForce ForceLimiter::limit(const Vec3& force_W) {
  LimitedForce out{.force_W = force_W};
  max_force_N_ =
      std::min(wanted_max_force_N_, max_force_N_ + wanted_max_force_N_ * activation_gain_per_tick_);
  const double length = length_of(out.force_W);
  if (length > max_force_N_) {
    out.force_W = shortened(out.force_W, length, max_force_N_);
    out.limits |= kLimitForce;
  }

  const Vec3 step = out.force_W - last_W_;
  const double step_length = length_of(step);
  if (step_length > max_step_N_) {
    out.force_W = last_W_ + shortened(step, step_length, max_step_N_);
    out.limits |= kLimitSlew;
  }
  last_W_ = out.force_W;
  return out;
}

double effort_scale(const Vec3& effort, const std::array<JointLimits, kJointCount>& limits,
                    const Vec3& given) {
  double scale = 1.0;
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const auto axis = static_cast<Eigen::Index>(joint);
    const double size = std::abs(effort[axis]);
    // The room in the direction of the effort: `given` takes from it or adds to it.
    const double room = limits[joint].max_effort - std::copysign(1.0, effort[axis]) * given[axis];
    if (size * scale > room) {
      scale = room / size;
    }
  }
  return scale;
}

}  // namespace tactus::firmware
