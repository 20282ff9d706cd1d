// The device of the exact limits: a mass and a damper, sampled and held, nothing else.
#pragma once

#include <limits>

#include "host_tools/certify/wall_contact.h"

namespace tactus::testing {

inline host::WallContact ideal_contact(double mass_kg, double damping_Ns_per_m, double rate_hz) {
  host::WallContact contact;
  contact.device.plant.moving_mass_kg = mass_kg;
  contact.device.plant.viscous_Ns_per_m = damping_Ns_per_m;
  contact.device.plant.joint_friction = {};
  contact.device.encoder_resolution = 1e-10;
  contact.device.velocity_cutoff_Hz = std::numeric_limits<double>::infinity();
  contact.device.effort_limit = 100.0;
  contact.device.motor_time_constant_s = 0.0;
  contact.device.delay_ticks = 0;
  contact.controller = firmware::cartesian_config();
  contact.controller.rate_hz = rate_hz;
  contact.controller.safety.max_force_N = 50.0;
  contact.controller.safety.force_slew_N_per_s = 1e6;
  for (firmware::JointLimits& joint : contact.controller.joints) {
    joint.max_effort = 100.0;
  }
  return contact;
}

}  // namespace tactus::testing
