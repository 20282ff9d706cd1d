// The configuration of an axis that is wired to a board: its lines, its encoder and its bridge.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"
#include "hal/clock.h"
#include "hal/gpio_lines.h"

namespace tactus::drivers {

// An input line of the GPIO chip.
struct InputPin {
  std::uint32_t offset = 0;  // number of the line on the chip
  bool active_low = false;
  hal::GpioBias bias = hal::GpioBias::as_is;
};

// An output line of the GPIO chip; `offset` is its number on the chip.
struct OutputPin {
  std::uint32_t offset = 0;
  bool active_low = false;
  hal::GpioDrive drive = hal::GpioDrive::push_pull;
};

// The encoder of the axis and the checks of its counts.
struct EncoderConfig {
  std::uint32_t counts_per_rev = 0;  // four times the lines; 4 to 10'000'000
  double max_speed_rad_per_s = 0.0;  // of the encoder's shaft; faster is a fault. Above 0, to 1e5
  bool reversed = false;  // the count grows when the shaft turns in the negative direction
  // The state of both channels in which the index is taken: bit 1 is A, bit 0 is B. For GPIO edges
  // only, since a counter latches by itself.
  std::uint8_t index_state = 0b11;
  std::uint32_t index_tolerance_counts = 1;  // to a quarter turn
  std::uint32_t velocity_window_us = 1000;   // 0 to 20'000
  // A torque of this share of max_torque_Nm without an edge for silence_ms is a fault. 0 ms
  // switches the check off.
  double silence_torque = 0.25;       // 0 to 1
  std::uint32_t silence_ms = 1000;    // 0 to 60'000
  std::uint64_t counter_ceiling = 0;  // hal::CounterConfig; not for GPIO edges
  bool counter_index = false;         // the counter has an index signal; not for GPIO edges
};

enum class BridgeMode : std::uint8_t {
  sign_magnitude,   // PWM is the size, a direction line the sign
  locked_antiphase  // PWM 50 % is zero, 0 and 100 % are full torque; needs an enable line
};
constexpr auto setting_words(BridgeMode /*of*/) {
  return std::to_array<Word<BridgeMode>>({{"sign_magnitude", BridgeMode::sign_magnitude},
                                          {"locked_antiphase", BridgeMode::locked_antiphase}});
}

enum class TorqueLaw : std::uint8_t {
  linear,      // torque is in proportion to the duty
  square_root  // to its square, as the Hapkit's bridge: duty = sqrt(torque / full torque)
};
constexpr auto setting_words(TorqueLaw /*of*/) {
  return std::to_array<Word<TorqueLaw>>(
      {{"linear", TorqueLaw::linear}, {"square_root", TorqueLaw::square_root}});
}

// The bridge of the axis and its limits.
struct BridgeConfig {
  BridgeMode mode = BridgeMode::sign_magnitude;
  TorqueLaw law = TorqueLaw::linear;
  double full_duty_torque_Nm = 0.0;  // at the shaft, at a duty of 1. Above 0, to 1000
  double max_torque_Nm = 0.0;        // clamps every command. Above 0, to full_duty_torque_Nm
  double max_duty = 1.0;             // of the period; above 0, to 1. Bootstrapped bridges need less
  hal::TimeNs pwm_period_ns = 40'000;   // 1000 to 10'000'000
  std::uint32_t direction_dead_us = 0;  // at zero duty before the direction changes; to 100'000
  bool reversed = false;                // the motor turns in the negative direction
};

// The contacts and lines of the board. Lines that are not connected are left out. Active always
// means the condition in the line's name. A normally closed contact to ground with a pull-up is
// active when it opens or its wire breaks.
struct AxisPins {
  std::optional<InputPin> encoder_a;  // both, or none with a counter
  std::optional<InputPin> encoder_b;
  std::optional<InputPin> encoder_index;
  std::optional<InputPin> fault;           // of the bridge; latched
  std::optional<InputPin> emergency_stop;  // the chain is open; acts on the first edge
  std::optional<InputPin> limit_low;       // blocks torque in the negative direction
  std::optional<InputPin> limit_high;      // blocks torque in the positive direction
  std::optional<OutputPin> direction;      // active: the negative direction
  std::optional<OutputPin> enable;         // of the bridge
  std::optional<OutputPin> brake_release;  // active: the brake is open
  std::optional<OutputPin> heartbeat;      // toggled by every write while the motor has power
};

// The whole axis.
struct GpioAxisConfig {
  EncoderConfig encoder;
  BridgeConfig bridge;
  AxisPins pins;
  std::uint32_t limit_debounce_us = 5000;  // 0 to 100'000; by the kernel
  std::uint32_t emergency_stop_release_ms =
      50;                                 // it must be closed for so long before a reset; to 10'000
  std::uint32_t torque_ramp_ms = 50;      // from zero to full torque after power-up; to 10'000
  std::uint32_t command_timeout_ms = 20;  // power off when no write comes; 1 to 1000
  std::size_t edge_buffer = 1024;         // events that the kernel keeps; 16 to 1024

  // True: the owner accepts a bridge that no circuit switches off, so that the motor may keep its
  // torque when the host dies.
  bool unproven_watchdog = false;
};

// Checks that all fields are in range and fit together. An error names the field from here, such as
// "bridge.max_torque_Nm". `over_counter` is true if the position comes from a hal::Counter instead
// of GPIO edges.
Checked check(const GpioAxisConfig& config, bool over_counter);

}  // namespace tactus::drivers
