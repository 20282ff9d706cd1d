// What a CiA 402 drive on CANopen needs to be told.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/field_error.h"

namespace tactus::drivers {

// Where the torque behind 6071 and 6077 (0.1 % of the rated torque) comes from.
enum class RatedTorque : std::uint8_t {
  drive_mNm,   // 6076:00 counts mN m, as the profile says
  drive_uNm,   // 6076:00 counts uN m
  configured,  // rated_torque_Nm stands, whatever 6076:00 says
};

struct Cia402Config {
  std::uint8_t node = 1;  // 1..127
  // The host sends each drive a heartbeat of its own, so that the watchdog of one can be proven
  // while another pushes. Their numbers count down from here, see heartbeat_node. 1..127.
  std::uint8_t host_node = 127;
  // Exactly one drive of a bus leads it: sends the SYNC. See check_bus.
  bool leads_bus = true;

  double period_s = 0.001;          // of the ticks, so of the SYNC; 0.0005..0.02
  double counts_per_turn = 4096.0;  // of 6064:00, after the drive's own gearing; 1..2^31
  double max_torque_Nm = 0.0;       // at the motor's shaft; above 0, to 1000
  RatedTorque rated_torque_from = RatedTorque::drive_mNm;
  // Of the motor's data sheet, 0..1000. If the drive reports another (by more than a fifth), it
  // does not come up: most likely the unit is wrong. 0 believes the drive.
  double rated_torque_Nm = 0.0;

  // A position that takes a faster shaft, by more than the margin, is an encoder fault.
  double max_speed_rad_per_s = 400.0;  // 1..10000
  double jump_margin_rad = 0.01;       // 0..1
  // One unit of 606C:00, which makers choose freely; to 1000. 0 takes the velocity from the
  // positions, filtered, and saves a frame in each tick.
  double velocity_unit_rad_per_s = 0.0;
  double velocity_filter_s = 0.001;  // 0..0.1

  // False: the torque acts at the next SYNC, all axes at once and to the microsecond. True: when
  // its frame arrives, most of a tick earlier, if the drive can (transmission type 255).
  bool torque_on_receipt = false;

  std::uint16_t watchdog_ms = 20;         // how long the drive waits for the host; 5..1000
  std::uint16_t drive_heartbeat_ms = 20;  // 5..1000
  double lost_after_s = 0.003;            // without a sample; 1.5 periods..1
  double sdo_timeout_s = 0.5;             // 0.01..5
  double bring_up_timeout_s = 5.0;        // from reset to ready; 0.1..60
  double enable_timeout_s = 1.0;          // from power wanted to power on; 0.01..10

  // True: the bring-up leaves out the proof of the drive's watchdog. The owner accepts that the
  // motor may keep its torque when the host dies.
  bool unproven_watchdog = false;
};

Checked check(const Cia402Config& config);

// The node number under which the host sends the heartbeat that this drive watches:
// host_node + 1 - node. Below 1 for a configuration that `check` refuses.
int heartbeat_node(const Cia402Config& config);

// Drives that share a bus: besides each by itself, that their nodes differ and are not the
// host's, exactly one leads, and they agree on host_node and the period.
Checked check_bus(std::span<const Cia402Config> configs);

}  // namespace tactus::drivers
