#include "firmware/device/device_settings.h"

#include <charconv>

namespace tactus::firmware {

// ---- words of the enumerations

template <>
inline constexpr auto kWords<drivers::ReferenceKind> =
    std::to_array<Word<drivers::ReferenceKind>>({{"absolute", drivers::ReferenceKind::absolute},
                                                 {"board", drivers::ReferenceKind::board},
                                                 {"known_pose", drivers::ReferenceKind::known_pose},
                                                 {"index", drivers::ReferenceKind::index},
                                                 {"hard_stop", drivers::ReferenceKind::hard_stop}});
template <>
inline constexpr std::string_view kWordList<drivers::ReferenceKind> =
    R"(must be "absolute", "board", "known_pose", "index" or "hard_stop")";

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

// ---- lines of a GPIO chip: "4", "4 active_low pull_up"

namespace {

constexpr std::string_view kPinRule =
    "must be a line's number in quotes, with the words active_low, pull_up, pull_down as needed";

std::string_view next_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const std::string_view word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(word.size());
  return word;
}

bool read_line_number(std::string_view word, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

std::string_view assign(drivers::InputPin& pin, const Setting& setting) {
  std::string_view rest = setting.text;
  if (setting.type != SettingType::text || !read_line_number(next_word(rest), pin.offset)) {
    return kPinRule;
  }
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    if (word == "active_low") {
      pin.active_low = true;
    } else if (word == "pull_up") {
      pin.bias = hal::GpioBias::pull_up;
    } else if (word == "pull_down") {
      pin.bias = hal::GpioBias::pull_down;
    } else {
      return kPinRule;
    }
  }
  return {};
}

std::string_view assign(drivers::OutputPin& pin, const Setting& setting) {
  std::string_view rest = setting.text;
  if (setting.type != SettingType::text || !read_line_number(next_word(rest), pin.offset)) {
    return kPinRule;
  }
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    if (word == "active_low") {
      pin.active_low = true;
    } else if (word == "open_drain") {
      pin.drive = hal::GpioDrive::open_drain;
    } else {
      return "must be a line's number in quotes, with the words active_low, open_drain as needed";
    }
  }
  return {};
}

// ---- device, controller

std::span<const Binding<DeviceConfig>> device_keys() {
  static constexpr std::array kKeys{
      bind<&DeviceConfig::name>("name"),
      bind<&DeviceConfig::read_limit_s>("read_limit_s", "s"),
      bind<&DeviceConfig::watchdog_chip>("watchdog_chip"),
      bind<&DeviceConfig::watchdog_line>("watchdog_line"),
  };
  return kKeys;
}

std::span<const Binding<ControllerConfig>> controller_keys() {
  using C = ControllerConfig;
  using S = SafetyConfig;
  static constexpr std::array kKeys{
      bind<&C::rate_hz>("rate_hz", "hz"),
      bind<&C::velocity_cutoff_hz>("velocity_cutoff_hz", "hz"),
      bind<&C::workspace_origin_D>("workspace_origin_m", "m"),
      bind<&C::gravity_D>("gravity_m_per_s2", "m_per_s2"),
      bind<&C::safety, &S::max_force_N>("max_force_N", "N"),
      bind<&C::safety, &S::force_slew_N_per_s>("force_slew_N_per_s", "N_per_s"),
      bind<&C::safety, &S::soft_start_s>("soft_start_s", "s"),
      bind<&C::safety, &S::contact_start_s>("contact_start_s", "s"),
      bind<&C::safety, &S::max_sample_age_us>("max_sample_age_us", "us"),
      bind<&C::safety, &S::stale_ticks_to_fault>("stale_ticks_to_fault"),
      bind<&C::safety, &S::late_ticks_to_fault>("late_ticks_to_fault"),
      bind<&C::safety, &S::max_tick_gap_s>("max_tick_gap_s", "s"),
      bind<&C::safety, &S::max_joint_speed>("max_joint_speed"),
      bind<&C::safety, &S::frozen_travel>("frozen_travel"),
      bind<&C::safety, &S::blocked_effort_share>("blocked_effort_share"),
      bind<&C::safety, &S::blocked_s>("blocked_s", "s"),
      bind<&C::safety, &S::max_tool_speed_m_per_s>("max_tool_speed_m_per_s", "m_per_s"),
      bind<&C::safety, &S::runaway_speed_m_per_s>("runaway_speed_m_per_s", "m_per_s"),
      bind<&C::safety, &S::runaway_travel_m>("runaway_travel_m", "m"),
      bind<&C::safety, &S::workspace_lower_W>("workspace_lower_m", "m"),
      bind<&C::safety, &S::workspace_upper_W>("workspace_upper_m", "m"),
      bind<&C::safety, &S::workspace_stiffness_N_per_m>("workspace_stiffness_N_per_m", "N_per_m"),
      bind<&C::safety, &S::workspace_damping_Ns_per_m>("workspace_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::workspace_overrun_m>("workspace_overrun_m", "m"),
      bind<&C::safety, &S::device_damping_Ns_per_m>("device_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::passivity_damping_Ns_per_m>("passivity_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::passivity_fault_J>("passivity_fault_J", "J"),
  };
  return kKeys;
}

// ---- connections

std::span<const Binding<ConnectionConfig>> connection_keys() {
  static constexpr std::array kKeys{bind<&ConnectionConfig::name>("name")};
  return kKeys;
}

std::span<const Binding<CanConnection>> can_keys() {
  static constexpr std::array kKeys{bind<&CanConnection::interface>("interface")};
  return kKeys;
}

std::span<const Binding<FalconConnection>> falcon_keys() {
  using C = FalconConnection;
  using F = drivers::FalconConfig;
  static constexpr std::array kKeys{
      bind<&C::firmware_file>("firmware_file"),
      bind<&C::falcon, &F::motor_units_per_Nm>("motor_units_per_Nm", "per_Nm"),
      bind<&C::falcon, &F::torque_limit_Nm>("torque_limit_Nm", "Nm"),
      bind<&C::falcon, &F::velocity_cutoff_Hz>("velocity_cutoff_hz", "hz"),
      bind<&C::falcon, &F::fastest_rad_per_s>("fastest_rad_per_s", "rad_per_s"),
  };
  return kKeys;
}

std::span<const Binding<HaplyConnection>> haply_keys() {
  using C = HaplyConnection;
  using H = drivers::HaplyConfig;
  static constexpr std::array kKeys{
      bind<&C::port>("port"),
      bind<&C::haply, &H::device_id>("device_id"),
      bind<&C::haply, &H::torque_limit_Nm>("torque_limit_Nm", "Nm"),
      bind<&C::haply, &H::velocity_cutoff_Hz>("velocity_cutoff_hz", "hz"),
      bind<&C::haply, &H::fastest_rad_per_s>("fastest_rad_per_s", "rad_per_s"),
      bind<&C::haply, &H::home_tolerance_rad>("home_tolerance_rad", "rad"),
  };
  return kKeys;
}

std::span<const Binding<GpioConnection>> gpio_keys() {
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

// ---- axes

std::span<const Binding<AxisConfig>> axis_keys() {
  static constexpr std::array kKeys{
      bind<&AxisConfig::name>("name"),
      bind<&AxisConfig::connection_name>("connection"),
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
      bind<&C::estimates>("estimates"),
      bind<&C::ask_by_remote_frame>("ask_by_remote_frame"),
      bind<&C::estimate_stale_s>("estimate_stale_s", "s"),
      bind<&C::estimate_lost_s>("estimate_lost_s", "s"),
      bind<&C::heartbeat_lost_s>("heartbeat_lost_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s"),
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
      bind<&C::offers_position>("offers_position"),
      bind<&C::max_speed_rad_per_s>("max_speed_rad_per_s", "rad_per_s"),
      bind<&C::jump_margin_rad>("jump_margin_rad", "rad"),
      bind<&C::status_period_s>("status_period_s", "s"),
      bind<&C::lost_after_s>("lost_after_s", "s"),
      bind<&C::poll_period_s>("poll_period_s", "s"),
      bind<&C::bring_up_s>("bring_up_s", "s"),
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
  };
  return kKeys;
}

// ---- joints

namespace {

using J = JointConfig;
using T = drivers::Transmission;
using R = drivers::Reference;

constexpr std::array kCommonJointKeys{
    bind<&J::name>("name"),
    bind<&J::motor_name>("motor"),
    bind<&J::encoder_name>("encoder"),
    bind<&J::transmission, &T::motor_ratio>("motor_ratio"),
    bind<&J::transmission, &T::encoder_ratio>("encoder_ratio"),
    bind<&J::transmission, &T::motor_direction>("motor_direction"),
    bind<&J::transmission, &T::encoder_direction>("encoder_direction"),
    bind<&J::reference, &R::kind>("reference"),
    bind<&J::reference, &R::time_limit_s>("search_time_limit_s", "s"),
};

constexpr std::array kTurningKeys{
    bind<&J::transmission, &T::offset>("offset_rad", "rad"),
    bind<&J::reference, &R::position>("reference_rad", "rad"),
    bind<&J::reference, &R::search_effort>("search_effort_Nm", "Nm"),
    bind<&J::reference, &R::search_speed>("search_speed_rad_per_s", "rad_per_s"),
    bind<&J::limits, &JointLimits::lower>("lower_rad", "rad"),
    bind<&J::limits, &JointLimits::upper>("upper_rad", "rad"),
    bind<&J::limits, &JointLimits::max_effort>("max_effort_Nm", "Nm"),
};

constexpr std::array kSlidingKeys{
    bind<&J::transmission, &T::offset>("offset_m", "m"),
    bind<&J::reference, &R::position>("reference_m", "m"),
    bind<&J::reference, &R::search_effort>("search_effort_N", "N"),
    bind<&J::reference, &R::search_speed>("search_speed_m_per_s", "m_per_s"),
    bind<&J::limits, &JointLimits::lower>("lower_m", "m"),
    bind<&J::limits, &JointLimits::upper>("upper_m", "m"),
    bind<&J::limits, &JointLimits::max_effort>("max_effort_N", "N"),
};

template <class S, std::size_t A, std::size_t B>
constexpr std::array<Binding<S>, A + B> joined(const std::array<Binding<S>, A>& a,
                                               const std::array<Binding<S>, B>& b) {
  std::array<Binding<S>, A + B> all{};
  for (std::size_t i = 0; i < A; ++i) {
    all[i] = a[i];
  }
  for (std::size_t i = 0; i < B; ++i) {
    all[A + i] = b[i];
  }
  return all;
}

}  // namespace

std::span<const Binding<JointConfig>> turning_joint_keys() {
  static constexpr auto kKeys = joined(kCommonJointKeys, kTurningKeys);
  return kKeys;
}

std::span<const Binding<JointConfig>> sliding_joint_keys() {
  static constexpr auto kKeys = joined(kCommonJointKeys, kSlidingKeys);
  return kKeys;
}

// ---- plant

namespace {

using Plant = PlantConfig;
constexpr std::array kCommonPlantKeys{
    bind<&Plant::moving_mass_kg>("moving_mass_kg", "kg"),
    bind<&Plant::viscous_Ns_per_m>("viscous_Ns_per_m", "Ns_per_m"),
    bind<&Plant::velocity_cutoff_hz>("velocity_cutoff_hz", "hz"),
    bind<&Plant::motor_time_constant_s>("motor_time_constant_s", "s"),
    bind<&Plant::delay_ticks>("delay_ticks"),
};
constexpr std::array kTurningPlantKeys{
    bind<&Plant::coulomb_friction>("coulomb_friction_Nm", "Nm"),
    bind<&Plant::breakaway_friction>("breakaway_friction_Nm", "Nm"),
    bind<&Plant::encoder_resolution>("encoder_resolution_rad", "rad"),
};
constexpr std::array kSlidingPlantKeys{
    bind<&Plant::coulomb_friction>("coulomb_friction_N", "N"),
    bind<&Plant::breakaway_friction>("breakaway_friction_N", "N"),
    bind<&Plant::encoder_resolution>("encoder_resolution_m", "m"),
};

}  // namespace

std::span<const Binding<PlantConfig>> turning_plant_keys() {
  static constexpr auto kKeys = joined(kCommonPlantKeys, kTurningPlantKeys);
  return kKeys;
}

std::span<const Binding<PlantConfig>> sliding_plant_keys() {
  static constexpr auto kKeys = joined(kCommonPlantKeys, kSlidingPlantKeys);
  return kKeys;
}

// ---- mechanisms

std::span<const Binding<CartesianGeometry>> cartesian_keys() {
  static constexpr std::array kKeys{bind<&CartesianGeometry::carried_kg>("carried_kg", "kg")};
  return kKeys;
}

std::span<const Binding<DeltaGeometry>> delta_keys() {
  using G = DeltaGeometry;
  static constexpr std::array kKeys{
      bind<&G::arm_m>("arm_m", "m"),
      bind<&G::rod_m>("rod_m", "m"),
      bind<&G::hinge_offset_m>("hinge_offset_m", "m"),
      bind<&G::base_radius_m>("base_radius_m", "m"),
      bind<&G::base_tangent_m>("base_tangent_m", "m"),
      bind<&G::platform_radius_m>("platform_radius_m", "m"),
      bind<&G::platform_tangent_m>("platform_tangent_m", "m"),
      bind<&G::azimuth_rad>("azimuth_rad", "rad"),
      bind<&G::nominal_height_m>("nominal_height_m", "m"),
      bind<&G::arm, &LinkWeight::mass_kg>("arm_kg", "kg"),
      bind<&G::arm, &LinkWeight::centre_m>("arm_centre_m", "m"),
      bind<&G::rods_kg>("rods_kg", "kg"),
      bind<&G::platform_kg>("platform_kg", "kg"),
  };
  return kKeys;
}

std::span<const Binding<PaddleGeometry>> paddle_keys() {
  using G = PaddleGeometry;
  static constexpr std::array kKeys{
      bind<&G::handle_radius_m>("handle_radius_m", "m"),
      bind<&G::paddle, &LinkWeight::mass_kg>("paddle_kg", "kg"),
      bind<&G::paddle, &LinkWeight::centre_m>("paddle_centre_m", "m"),
  };
  return kKeys;
}

std::span<const Binding<PantographGeometry>> pantograph_keys() {
  using G = PantographGeometry;
  static constexpr std::array kKeys{
      bind<&G::base_m>("base_m", "m"),
      bind<&G::proximal_m>("proximal_m", "m"),
      bind<&G::distal_m>("distal_m", "m"),
      bind<&G::proximal, &LinkWeight::mass_kg>("proximal_kg", "kg"),
      bind<&G::proximal, &LinkWeight::centre_m>("proximal_centre_m", "m"),
      bind<&G::distal, &LinkWeight::mass_kg>("distal_kg", "kg"),
      bind<&G::distal, &LinkWeight::centre_m>("distal_centre_m", "m"),
      bind<&G::tool_kg>("tool_kg", "kg"),
  };
  return kKeys;
}

std::span<const Binding<SerialArmGeometry>> serial_arm_keys() {
  using G = SerialArmGeometry;
  static constexpr std::array kKeys{
      bind<&G::upper_m>("upper_m", "m"),
      bind<&G::forearm_m>("forearm_m", "m"),
      bind<&G::shoulder_height_m>("shoulder_height_m", "m"),
      bind<&G::upper, &LinkWeight::mass_kg>("upper_kg", "kg"),
      bind<&G::upper, &LinkWeight::centre_m>("upper_centre_m", "m"),
      bind<&G::forearm, &LinkWeight::mass_kg>("forearm_kg", "kg"),
      bind<&G::forearm, &LinkWeight::centre_m>("forearm_centre_m", "m"),
      bind<&G::tool_kg>("tool_kg", "kg"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
