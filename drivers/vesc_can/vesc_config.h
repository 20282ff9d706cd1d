// The configuration of a VESC. The other settings are made with VESC Tool, see README.md.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"

namespace tactus::drivers {

// The settings of one VESC.
struct VescConfig {
  std::uint8_t vesc_id = 0;    // 0..254
  std::uint8_t host_id = 253;  // the host's own; no VESC may have it; 0..254

  double torque_constant_Nm_per_A = 0.0;  // of the motor's data sheet; 0.0001..10
  double max_torque_Nm = 0.0;             // at the motor's shaft; above 0, to 100
  std::uint8_t pole_pairs = 7;            // 1..60
  // The time for which the VESC keeps regulating a current near zero; 0.01..30. A motor that is
  // released follows late.
  double off_delay_s = 0.1;

  // The VESC's timeout, as it is set in VESC Tool; 0.001..1. The bring-up proves that it releases
  // the motor in that time.
  double watchdog_s = 0.02;
  // True: the owner accepts a VESC whose timeout was not proven, so that the motor may keep its
  // torque when the host dies.
  bool unproven_watchdog = false;

  // True: the tachometer is the position. Six counts an electrical turn are too coarse for touch,
  // but enough for limits and for a rough joint. False: the axis is a torque amplifier whose
  // samples have no time.
  bool offers_position = false;
  // A speed above this one is an encoder fault. So is a position that implies one, by more than two
  // counts and the margin.
  double max_speed_rad_per_s = 1000.0;  // 1..100000
  double jump_margin_rad = 0.05;        // 0..3

  double status_period_s = 0.005;  // period of the status messages, as set in VESC Tool; 0.001..0.1
  double lost_after_s = 0.02;      // longest time without a status; 2.5 status periods..1
  double poll_period_s = 0.01;     // period of the questions for faults; 0.001..1
  double bring_up_s = 2.0;         // longest time until the VESC is there without a fault; 0.1..60
};

// Returns the keys of device.toml.
std::span<const Binding<VescConfig>> vesc_keys();

// Checks every field against its range.
Checked check(const VescConfig& config);

}  // namespace tactus::drivers
