#include "drivers/gpio_axis/registration.h"

#include "drivers/gpio_axis/pin_setting.h"

namespace tactus::drivers::gpio {

std::span<const Binding<GpioConnection>> connection_keys() {
  using C = GpioConnection;
  static constexpr std::array kKeys{
      bind<&C::chip>("chip"),
      bind<&C::pwm_folder>("pwm_folder"),
      bind<&C::pwm_channel>("pwm_channel"),
      bind<&C::counter>("counter"),
      bind<&C::counter_channel>("counter_channel"),
  };
  return kKeys;
}

Checked check(const GpioConnection& connection) {
  if (connection.chip.empty()) {
    return std::unexpected(
        FieldError{"chip", "must be the label or the path of a GPIO chip; see gpiodetect"});
  }
  if (!is_absolute_path(connection.pwm_folder)) {
    return std::unexpected(
        FieldError{"pwm_folder", "must be a path from the root on, \"/sys/class/pwm/pwmchip0\""});
  }
  return {};
}

std::string_view shared_key(const GpioConnection& one, const GpioConnection& other) {
  if (one.pwm_folder == other.pwm_folder && one.pwm_channel == other.pwm_channel) {
    return "pwm_channel";
  }
  return !one.counter.empty() && one.counter == other.counter &&
                 one.counter_channel == other.counter_channel
             ? "counter"
             : "";
}

std::span<const Binding<GpioAxisConfig>> keys() {
  using C = GpioAxisConfig;
  using E = EncoderConfig;
  using B = BridgeConfig;
  using P = AxisPins;
  static constexpr std::array kKeys{
      bind<&C::encoder, &E::counts_per_rev>("counts_per_turn"),
      bind<&C::encoder, &E::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::encoder, &E::reversed>("encoder_reversed"),
      bind<&C::encoder, &E::index_state>("index_state"),
      bind<&C::encoder, &E::index_tolerance_counts>("index_tolerance_counts"),
      bind<&C::encoder, &E::velocity_window_us>("velocity_window_us", "us"),
      bind<&C::encoder, &E::counter_ceiling>("counter_ceiling"),
      bind<&C::encoder, &E::counter_index>("counter_index"),
      bind<&C::encoder, &E::silence_torque>("silence_torque"),
      bind<&C::encoder, &E::silence_ms>("silence_ms", "ms"),
      bind<&C::bridge, &B::mode>("bridge"),
      bind<&C::bridge, &B::law>("torque_law"),
      bind<&C::bridge, &B::full_duty_torque_Nm>("full_duty_torque_Nm", "Nm"),
      bind<&C::bridge, &B::max_torque_Nm>("max_torque_Nm", "Nm"),
      bind<&C::bridge, &B::max_duty>("max_duty"),
      bind<&C::bridge, &B::pwm_period_ns>("pwm_period_ns", "ns"),
      bind<&C::bridge, &B::direction_dead_us>("direction_dead_us", "us"),
      bind<&C::bridge, &B::reversed>("motor_reversed"),
      bind<&C::pins, &P::encoder_a>("encoder_a"),
      bind<&C::pins, &P::encoder_b>("encoder_b"),
      bind<&C::pins, &P::encoder_index>("encoder_index"),
      bind<&C::pins, &P::fault>("fault"),
      bind<&C::pins, &P::emergency_stop>("emergency_stop"),
      bind<&C::pins, &P::limit_low>("limit_low"),
      bind<&C::pins, &P::limit_high>("limit_high"),
      bind<&C::pins, &P::direction>("direction"),
      bind<&C::pins, &P::enable>("enable"),
      bind<&C::pins, &P::brake_release>("brake_release"),
      bind<&C::pins, &P::heartbeat>("heartbeat"),
      bind<&C::limit_debounce_us>("limit_debounce_us", "us"),
      bind<&C::emergency_stop_release_ms>("emergency_stop_release_ms", "ms"),
      bind<&C::torque_ramp_ms>("torque_ramp_ms", "ms"),
      bind<&C::command_timeout_ms>("command_timeout_ms", "ms"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

bool has_index(const GpioAxisConfig& config) {
  return config.pins.encoder_index || config.encoder.counter_index;
}

std::string_view reference_advice(const GpioAxisConfig& config) {
  return has_index(config)
             ? R"(a gpio_axis with an index can have "index", "known_pose" or "hard_stop")"
             : R"(a gpio_axis counts from where it wakes up: "known_pose", "hard_stop", or with )"
               R"(an encoder_index "index")";
}

UsedLines lines(const GpioAxisConfig& config) {
  const AxisPins& pins = config.pins;
  const auto used = [](std::string_view key, const auto& pin) {
    return UsedLine{key, pin ? std::optional(pin->offset) : std::nullopt};
  };
  return {{used("encoder_a", pins.encoder_a), used("encoder_b", pins.encoder_b),
           used("encoder_index", pins.encoder_index), used("fault", pins.fault),
           used("emergency_stop", pins.emergency_stop), used("limit_low", pins.limit_low),
           used("limit_high", pins.limit_high), used("direction", pins.direction),
           used("enable", pins.enable), used("brake_release", pins.brake_release),
           used("heartbeat", pins.heartbeat)}};
}

}  // namespace tactus::drivers::gpio
