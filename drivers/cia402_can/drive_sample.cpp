#include "drivers/cia402_can/drive_sample.h"

#include <cmath>
#include <numbers>

namespace tactus::drivers::cia402 {

namespace {

CountedShaftConfig drive_shaft(const Cia402Config& config) {
  return {.rad_per_count = 2.0 * std::numbers::pi / config.counts_per_turn,
          .max_speed_rad_per_s = config.max_speed_rad_per_s,
          .jump_margin_rad = config.jump_margin_rad,
          .velocity_filter_s = config.velocity_filter_s};
}

}  // namespace

DriveSample::DriveSample(const Cia402Config& config)
    : shaft_(drive_shaft(config)),
      velocity_unit_rad_per_s_(config.velocity_unit_rad_per_s),
      max_speed_rad_per_s_(config.max_speed_rad_per_s) {}

void DriveSample::forget() {
  shaft_.forget();
  sample_ = AxisSample{};
}

void DriveSample::show(double torque_Nm, hal::TimeNs time_ns) {
  sample_.time_ns = time_ns;
  sample_.position_rad = shaft_.position_rad();
  if (velocity_unit_rad_per_s_ == 0.0) {
    sample_.velocity_rad_per_s = shaft_.velocity_rad_per_s();
  }
  sample_.torque_Nm = torque_Nm;
  sample_.has_torque = true;
  sample_.torque_time_ns = time_ns;
}

bool DriveSample::take_velocity(std::int32_t velocity) {
  if (velocity_unit_rad_per_s_ == 0.0) {
    return true;
  }
  const double velocity_rad_per_s = velocity_unit_rad_per_s_ * velocity;
  if (std::abs(velocity_rad_per_s) > max_speed_rad_per_s_) {
    return false;
  }
  sample_.velocity_rad_per_s = velocity_rad_per_s;
  return true;
}

}  // namespace tactus::drivers::cia402
