// The configuration of one moteus servo on a CAN FD bus.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"

namespace tactus::drivers {

// The time at which the servo is asked for its sample. with_command asks in the torque's frame; the
// answer is there at the next tick and is one period old. before_command asks in a frame of its own
// at the start of each tick; this costs bus time and gives samples a fraction of a millisecond old.
enum class MoteusQuery : std::uint8_t { with_command, before_command };
constexpr auto setting_words(MoteusQuery /*of*/) {
  return std::to_array<Word<MoteusQuery>>({{"with_command", MoteusQuery::with_command},
                                           {"before_command", MoteusQuery::before_command}});
}

// The settings of one servo. Angles and torque are those of its output shaft.
struct MoteusConfig {
  std::uint8_t servo_id = 1;    // 1 to 126
  std::uint8_t host_id = 0;     // 0 to 127
  std::uint16_t prefix = 0;     // can.prefix of the servo: 0 to 8191
  bool bit_rate_switch = true;  // the payload has the faster bit rate
  double max_torque_Nm = 0.2;   // at the output shaft; clamps every command; above 0, up to 1000
  double watchdog_s = 0.02;  // time without a command after which the servo times out: 0.002 to 1
  double max_speed_rad_per_s = 200.0;  // larger than any real speed of the shaft: 0.1 to 10000
  double jump_margin_rad = 0.05;       // on top of it, between two samples: above 0, up to 3
  // The joint relies on an absolute position of the servo's output. A servo without one does not
  // come up.
  bool absolute_output = false;
  bool unproven_watchdog = false;  // the owner accepts a watchdog without its proof at bring-up
  MoteusQuery query = MoteusQuery::with_command;

  // The deadlines, 0.001 to 10 s. They must rise in this order.
  double reply_stale_s = 0.0022;  // kDeviceStale
  double reply_lost_s = 0.0034;   // kDeviceLost
  double bring_up_s = 1.0;        // for each step of the bring-up
};

// Returns the keys of device.toml.
std::span<const Binding<MoteusConfig>> moteus_keys();

// Checks every field against its range.
Checked check(const MoteusConfig& config);

}  // namespace tactus::drivers
