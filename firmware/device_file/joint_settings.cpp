// The keys of the joints and of the plant.
#include "firmware/device_file/device_settings.h"

namespace tactus::firmware {

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
    bind<&J::reference, &R::min_travel>("search_min_travel_rad", "rad"),
    bind<&J::limits, &JointLimits::lower>("lower_rad", "rad"),
    bind<&J::limits, &JointLimits::upper>("upper_rad", "rad"),
    bind<&J::limits, &JointLimits::max_effort>("max_effort_Nm", "Nm"),
};

constexpr std::array kSlidingKeys{
    bind<&J::transmission, &T::offset>("offset_m", "m"),
    bind<&J::reference, &R::position>("reference_m", "m"),
    bind<&J::reference, &R::search_effort>("search_effort_N", "N"),
    bind<&J::reference, &R::search_speed>("search_speed_m_per_s", "m_per_s"),
    bind<&J::reference, &R::min_travel>("search_min_travel_m", "m"),
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

}  // namespace tactus::firmware
