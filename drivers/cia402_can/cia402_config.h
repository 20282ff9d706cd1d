// The configuration of a CiA 402 drive on CANopen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"

namespace tactus::drivers {

// The source of the rated torque. 6071 and 6077 count 0.1 % of it.
enum class RatedTorque : std::uint8_t {
  drive_mNm,   // 6076:00 in mN m, as the profile says
  drive_uNm,   // 6076:00 in uN m
  configured,  // rated_torque_Nm, whatever 6076:00 says
};
constexpr auto setting_words(RatedTorque /*of*/) {
  return std::to_array<Word<RatedTorque>>({{"drive_mNm", RatedTorque::drive_mNm},
                                           {"drive_uNm", RatedTorque::drive_uNm},
                                           {"configured", RatedTorque::configured}});
}

// The settings of one drive. Angles and torque are those of the motor's shaft.
struct Cia402Config {
  std::uint8_t node = 1;  // 1..127
  // The highest heartbeat node of the host, 1..127. The host sends each drive a heartbeat of its
  // own, so that the watchdog of one can be proven while another has torque. The nodes count down
  // from here, see heartbeat_node.
  std::uint8_t host_node = 127;
  // The drive that leads a bus sends the SYNC. Exactly one drive of a bus leads it, see check_bus.
  bool leads_bus = true;

  double period_s = 0.001;          // of the ticks and of the SYNC; 0.0005..0.02
  double counts_per_turn = 4096.0;  // of 6064:00, after the drive's own gearing; 1..2^31
  double max_torque_Nm = 0.0;       // at the motor's shaft; above 0, to 1000
  RatedTorque rated_torque_from = RatedTorque::drive_mNm;
  // The rated torque in the motor's data sheet, 0..1000. If the drive reports another (by more than
  // a fifth), it does not come up, since the unit is probably wrong. 0 accepts the drive's value.
  double rated_torque_Nm = 0.0;

  // A position that implies a faster shaft, by more than the margin, is an encoder fault.
  double max_speed_rad_per_s = 400.0;  // 1..10000
  double jump_margin_rad = 0.01;       // 0..1
  // One unit of 606C:00, which each maker chooses; to 1000. 0 derives the velocity from the
  // positions, filtered, and saves a frame in each tick.
  double velocity_unit_rad_per_s = 0.0;
  double velocity_filter_s = 0.001;  // 0..0.1

  // False: the torque acts at the next SYNC, in all axes at once and to the microsecond. True: it
  // acts when its frame arrives, most of a tick earlier, if the drive supports it (transmission
  // type 255).
  bool torque_on_receipt = false;

  std::uint16_t watchdog_ms =
      20;  // the longest silence of the host that the drive accepts; 5..1000
  std::uint16_t drive_heartbeat_ms = 20;  // 5..1000
  double lost_after_s = 0.003;            // longest time without a sample; 1.5 periods..1
  double sdo_timeout_s = 0.5;             // 0.01..5
  double bring_up_timeout_s = 5.0;        // from reset to ready; 0.1..60
  double enable_timeout_s = 1.0;          // from power wanted to power on; 0.01..10

  // True: the bring-up omits the proof of the drive's watchdog. The owner accepts that the motor
  // may keep its torque when the host dies.
  bool unproven_watchdog = false;
};

// Returns the keys of device.toml.
std::span<const Binding<Cia402Config>> cia402_keys();

// Checks every field against its range.
Checked check(const Cia402Config& config);

// Returns the node number of the heartbeat that the host sends to this drive: host_node + 1 - node.
// It is below 1 for a configuration that `check` refuses.
int heartbeat_node(const Cia402Config& config);

// Checks the drives of one bus: each by itself, that their nodes differ from each other and from
// the host's, that exactly one leads, and that they agree on host_node and the period.
Checked check_bus(std::span<const Cia402Config> configs);

}  // namespace tactus::drivers
