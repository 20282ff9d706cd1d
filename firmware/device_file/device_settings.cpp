#include "firmware/device_file/device_settings.h"

#include "drivers/gpio_axis/pin_setting.h"

namespace tactus::firmware {

// ---- device, controller

constexpr auto setting_words(OnFault /*kind*/) {
  return std::to_array<Word<OnFault>>({{"all", OnFault::all}, {"own", OnFault::own}});
}

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
      bind<&C::tick_instructions>("tick_instructions"),
      bind<&C::velocity_cutoff_hz>("velocity_cutoff_hz", "hz"),
      bind<&C::workspace_origin_D>("workspace_origin_m", "m"),
      bind<&C::gravity_D>("gravity_m_per_s2", "m_per_s2"),
      bind<&C::on_fault>("on_fault"),
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
      bind<&C::safety, &S::sign_check_N>("sign_check_N", "N"),
      bind<&C::safety, &S::max_tool_speed_m_per_s>("max_tool_speed_m_per_s", "m_per_s"),
      bind<&C::safety, &S::runaway_speed_m_per_s>("runaway_speed_m_per_s", "m_per_s"),
      bind<&C::safety, &S::runaway_travel_m>("runaway_travel_m", "m"),
      bind<&C::safety, &S::workspace_lower_W>("workspace_lower_m", "m"),
      bind<&C::safety, &S::workspace_upper_W>("workspace_upper_m", "m"),
      bind<&C::safety, &S::workspace_stiffness_N_per_m>("workspace_stiffness_N_per_m", "N_per_m"),
      bind<&C::safety, &S::workspace_damping_Ns_per_m>("workspace_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::workspace_overrun_m>("workspace_overrun_m", "m"),
      bind<&C::safety, &S::device_delay_s>("device_delay_s", "s"),
      bind<&C::safety, &S::device_damping_Ns_per_m>("device_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::passivity_damping_Ns_per_m>("passivity_damping_Ns_per_m", "Ns_per_m"),
      bind<&C::safety, &S::passivity_fault_travel_m>("passivity_fault_travel_m", "m"),
  };
  return kKeys;
}

// ---- connections, axes

std::span<const Binding<ConnectionConfig>> connection_keys() {
  static constexpr std::array kKeys{bind<&ConnectionConfig::name>("name")};
  return kKeys;
}

std::span<const Binding<AxisConfig>> axis_keys() {
  static constexpr std::array kKeys{
      bind<&AxisConfig::name>("name"),
      bind<&AxisConfig::connection_name>("connection"),
      bind<&AxisConfig::encoder>("encoder"),
      bind<&AxisConfig::encoder_turn_begins_rad>("encoder_turn_begins_rad", "rad"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
