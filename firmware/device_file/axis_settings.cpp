// The keys of the axes, one driver after the other.
#include "firmware/device_file/device_settings.h"
#include "firmware/device_file/pin_setting.h"

namespace tactus::firmware {

// ---- words of the enumerations

template <>
inline constexpr auto kWords<drivers::ODriveEstimates> =
    std::to_array<Word<drivers::ODriveEstimates>>(
        {{"cyclic", drivers::ODriveEstimates::cyclic},
         {"requested", drivers::ODriveEstimates::requested}});
template <>
inline constexpr std::string_view kWordList<drivers::ODriveEstimates> =
    R"(must be "cyclic" or "requested")";

template <>
inline constexpr auto kWords<drivers::BridgeMode> = std::to_array<Word<drivers::BridgeMode>>(
    {{"sign_magnitude", drivers::BridgeMode::sign_magnitude},
     {"locked_antiphase", drivers::BridgeMode::locked_antiphase}});
template <>
inline constexpr std::string_view kWordList<drivers::BridgeMode> =
    R"(must be "sign_magnitude" or "locked_antiphase")";

template <>
inline constexpr auto kWords<drivers::TorqueLaw> = std::to_array<Word<drivers::TorqueLaw>>(
    {{"linear", drivers::TorqueLaw::linear}, {"square_root", drivers::TorqueLaw::square_root}});
template <>
inline constexpr std::string_view kWordList<drivers::TorqueLaw> =
    R"(must be "linear" or "square_root")";

template <>
inline constexpr auto kWords<drivers::MoteusQuery> = std::to_array<Word<drivers::MoteusQuery>>(
    {{"with_command", drivers::MoteusQuery::with_command},
     {"before_command", drivers::MoteusQuery::before_command}});
template <>
inline constexpr std::string_view kWordList<drivers::MoteusQuery> =
    R"(must be "with_command" or "before_command")";

template <>
inline constexpr auto kWords<drivers::RatedTorque> =
    std::to_array<Word<drivers::RatedTorque>>({{"drive_mNm", drivers::RatedTorque::drive_mNm},
                                               {"drive_uNm", drivers::RatedTorque::drive_uNm},
                                               {"configured", drivers::RatedTorque::configured}});
template <>
inline constexpr std::string_view kWordList<drivers::RatedTorque> =
    R"(must be "drive_mNm", "drive_uNm" or "configured")";

template <>
inline constexpr auto kWords<EncoderKind> =
    std::to_array<Word<EncoderKind>>({{"incremental", EncoderKind::incremental},
                                      {"absolute_turn", EncoderKind::absolute_turn},
                                      {"absolute", EncoderKind::absolute}});
template <>
inline constexpr std::string_view kWordList<EncoderKind> =
    R"(must be "incremental", "absolute_turn" or "absolute")";

// ---- axes

std::span<const Binding<AxisConfig>> axis_keys() {
  static constexpr std::array kKeys{
      bind<&AxisConfig::name>("name"),
      bind<&AxisConfig::connection_name>("connection"),
      bind<&AxisConfig::encoder>("encoder"),
      bind<&AxisConfig::encoder_turn_begins_rad>("encoder_turn_begins_rad", "rad"),
  };
  return kKeys;
}

std::span<const Binding<BoardAxis>> board_axis_keys() {
  static constexpr std::array kKeys{bind<&BoardAxis::number>("number")};
  return kKeys;
}

std::span<const Binding<drivers::ODriveConfig>> odrive_keys() {
  using C = drivers::ODriveConfig;
  static constexpr std::array kKeys{
      bind<&C::node_id>("node_id"),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad"),
      bind<&C::drive_speed_limit_rad_per_s>("drive_speed_limit_rad_per_s", "rad_per_s"),
      bind<&C::drive_current_limit_A>("drive_current_limit_A", "A"),
      bind<&C::watchdog_s>("watchdog_s", "s"),
      bind<&C::torque_period_s>("torque_period_s", "s"),
      bind<&C::torque_constant_Nm_per_A>("torque_constant_Nm_per_A", "Nm_per_A"),
      bind<&C::estimates>("estimates"),
      bind<&C::ask_by_remote_frame>("ask_by_remote_frame"),
      bind<&C::estimate_stale_s>("estimate_stale_s", "s"),
      bind<&C::estimate_lost_s>("estimate_lost_s", "s"),
      bind<&C::heartbeat_lost_s>("heartbeat_lost_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

std::span<const Binding<drivers::MoteusConfig>> moteus_keys() {
  using C = drivers::MoteusConfig;
  static constexpr std::array kKeys{
      bind<&C::servo_id>("servo_id"),
      bind<&C::host_id>("host_id"),
      bind<&C::prefix>("prefix"),
      bind<&C::bit_rate_switch>("bit_rate_switch"),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm"),
      bind<&C::watchdog_s>("watchdog_s", "s"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad"),
      bind<&C::query>("query"),
      bind<&C::reply_stale_s>("reply_stale_s", "s"),
      bind<&C::reply_lost_s>("reply_lost_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

std::span<const Binding<drivers::Cia402Config>> cia402_keys() {
  using C = drivers::Cia402Config;
  static constexpr std::array kKeys{
      bind<&C::node>("node"),
      bind<&C::host_node>("host_node"),
      bind<&C::leads_bus>("leads_bus"),
      bind<&C::period_s>("period_s", "s"),
      bind<&C::counts_per_turn>("counts_per_turn"),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm"),
      bind<&C::rated_torque_from>("rated_torque_from"),
      bind<&C::rated_torque_Nm>("rated_torque_Nm", "Nm"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad"),
      bind<&C::velocity_unit_rad_per_s>("velocity_unit_rad_per_s", "rad_per_s"),
      bind<&C::velocity_filter_s>("velocity_filter_s", "s"),
      bind<&C::torque_on_receipt>("torque_on_receipt"),
      bind<&C::watchdog_ms>("watchdog_ms", "ms"),
      bind<&C::drive_heartbeat_ms>("drive_heartbeat_ms", "ms"),
      bind<&C::lost_after_s>("lost_after_s", "s"),
      bind<&C::sdo_timeout_s>("sdo_timeout_s", "s"),
      bind<&C::bring_up_timeout_s>("bring_up_timeout_s", "s"),
      bind<&C::enable_timeout_s>("enable_timeout_s", "s"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

std::span<const Binding<drivers::VescConfig>> vesc_keys() {
  using C = drivers::VescConfig;
  static constexpr std::array kKeys{
      bind<&C::vesc_id>("vesc_id"),
      bind<&C::host_id>("host_id"),
      bind<&C::torque_constant_Nm_per_A>("torque_constant_Nm_per_A", "Nm_per_A"),
      bind<&C::max_torque_Nm>("max_torque_Nm", "Nm"),
      bind<&C::pole_pairs>("pole_pairs"),
      bind<&C::off_delay_s>("off_delay_s", "s"),
      bind<&C::watchdog_s>("watchdog_s", "s"),
      bind<&C::offers_position>("offers_position"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad"),
      bind<&C::status_period_s>("status_period_s", "s"),
      bind<&C::lost_after_s>("lost_after_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

std::span<const Binding<drivers::GpioAxisConfig>> gpio_axis_keys() {
  using C = drivers::GpioAxisConfig;
  using E = drivers::EncoderConfig;
  using B = drivers::BridgeConfig;
  using P = drivers::AxisPins;
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

}  // namespace tactus::firmware
