#include "drivers/gpio_axis/gpio_axis_config.h"

#include <array>

namespace tactus::drivers {

namespace {

struct GpioAxisRule {
  bool holds;
  FieldError otherwise;
};

template <std::size_t kCount>
Checked first_broken_rule(const std::array<GpioAxisRule, kCount>& rules) {
  for (const GpioAxisRule& rule : rules) {
    if (!rule.holds) {
      return std::unexpected(rule.otherwise);
    }
  }
  return {};
}

// Returns true if 0 < value <= most; false for NaN.
bool is_above_zero_up_to(double value, double most) {
  return value > 0.0 && value <= most;
}

Checked check_gpio_encoder(const EncoderConfig& encoder, const AxisPins& pins, bool over_counter) {
  const bool has_channels = pins.encoder_a.has_value() && pins.encoder_b.has_value();
  const bool has_any =
      pins.encoder_a.has_value() || pins.encoder_b.has_value() || pins.encoder_index.has_value();
  return first_broken_rule(std::array<GpioAxisRule, 10>{{
      {encoder.counts_per_rev >= 4 && encoder.counts_per_rev <= 10'000'000,
       {"encoder.counts_per_rev", "must be from 4 to 10000000"}},
      {encoder.counts_per_rev % 4 == 0,
       {"encoder.counts_per_rev", "must be four times the encoder's lines"}},
      {is_above_zero_up_to(encoder.max_speed_rad_per_s, 1e5),
       {"encoder.max_speed_rad_per_s", "must be above 0 and at most 100000"}},
      {encoder.index_state < 4, {"encoder.index_state", "must be from 0 to 3"}},
      {encoder.index_tolerance_counts <= encoder.counts_per_rev / 4,
       {"encoder.index_tolerance_counts", "must be at most a quarter turn"}},
      {encoder.velocity_window_us <= 20'000,
       {"encoder.velocity_window_us", "must be at most 20000"}},
      {encoder.silence_torque >= 0.0 && encoder.silence_torque <= 1.0,
       {"encoder.silence_torque", "must be from 0 to 1"}},
      {encoder.silence_ms <= 60'000, {"encoder.silence_ms", "must be at most 60000"}},
      {over_counter || has_channels, {"pins.encoder_a", "and pins.encoder_b must be connected"}},
      {!over_counter || !has_any, {"pins.encoder_a", "must not be connected over a counter"}},
  }});
}

Checked check_gpio_bridge(const BridgeConfig& bridge, const AxisPins& pins) {
  const bool signed_by_line = bridge.mode == BridgeMode::sign_magnitude;
  return first_broken_rule(std::array<GpioAxisRule, 7>{{
      {is_above_zero_up_to(bridge.full_duty_torque_Nm, 1000.0),
       {"bridge.full_duty_torque_Nm", "must be above 0 and at most 1000"}},
      {is_above_zero_up_to(bridge.max_torque_Nm, bridge.full_duty_torque_Nm),
       {"bridge.max_torque_Nm", "must be above 0 and at most full_duty_torque_Nm"}},
      {is_above_zero_up_to(bridge.max_duty, 1.0),
       {"bridge.max_duty", "must be above 0 and at most 1"}},
      {bridge.pwm_period_ns >= 1000 && bridge.pwm_period_ns <= 10'000'000,
       {"bridge.pwm_period_ns", "must be from 1000 to 10000000"}},
      {bridge.direction_dead_us <= 100'000, {"bridge.direction_dead_us", "must be at most 100000"}},
      {!signed_by_line || pins.direction.has_value(),
       {"pins.direction", "must be connected for sign-magnitude"}},
      {signed_by_line || pins.enable.has_value(),
       {"pins.enable", "must be connected for locked anti-phase: a lost PWM is full torque"}},
  }});
}

}  // namespace

Checked check(const GpioAxisConfig& config, bool over_counter) {
  if (const auto checked = check_gpio_encoder(config.encoder, config.pins, over_counter);
      !checked) {
    return checked;
  }
  if (const auto checked = check_gpio_bridge(config.bridge, config.pins); !checked) {
    return checked;
  }
  return first_broken_rule(std::array<GpioAxisRule, 5>{{
      {config.limit_debounce_us <= 100'000, {"limit_debounce_us", "must be at most 100000"}},
      {config.emergency_stop_release_ms <= 10'000,
       {"emergency_stop_release_ms", "must be at most 10000"}},
      {config.torque_ramp_ms <= 10'000, {"torque_ramp_ms", "must be at most 10000"}},
      {config.command_timeout_ms >= 1 && config.command_timeout_ms <= 1000,
       {"command_timeout_ms", "must be from 1 to 1000"}},
      {config.edge_buffer >= 16 && config.edge_buffer <= hal::kMaxGpioEdgeBuffer,
       {"edge_buffer", "must be from 16 to 1024"}},
  }});
}

}  // namespace tactus::drivers
