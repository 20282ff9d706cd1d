// Lists every member of every struct of a configuration. A new member does not compile until it is
// added here; then change kConfigVersion.
#include "firmware/configuration/config_state.h"

#include "rendering/state_archive.h"

namespace tactus::firmware {

using rendering::FrictionKind;
using rendering::StateArchive;

// The bytes begin with it, so that an older recording is refused and not misread.
inline constexpr std::uint64_t kConfigVersion = 5;

template <std::size_t kKind>
void transfer_if(StateArchive& archive, MechanismGeometry& geometry, std::size_t kind) {
  if (kind != kKind) {
    return;
  }
  if (archive.is_reading()) {
    geometry.emplace<kKind>();
  }
  if (auto* const form = std::get_if<kKind>(&geometry); form != nullptr) {
    archive(*form);
  }
}

inline void transfer(StateArchive& archive, MechanismGeometry& geometry) {
  std::size_t kind = geometry.index();
  archive.up_to(kind, std::variant_size_v<MechanismGeometry> - 1);
  [&]<std::size_t... kKinds>(std::index_sequence<kKinds...>) {
    (transfer_if<kKinds>(archive, geometry, kind), ...);
  }(std::make_index_sequence<std::variant_size_v<MechanismGeometry>>{});
}

inline void transfer(StateArchive& archive, JointLimits& limits) {
  auto& [lower, upper, max_effort] = limits;
  archive(lower, upper, max_effort);
}

inline void transfer(StateArchive& archive, CoupledLimit& limit) {
  auto& [joint, minus, lower, upper] = limit;
  archive(joint, minus, lower, upper);
}

inline void transfer(StateArchive& archive, JointFriction& friction) {
  auto& [model, compensated_share, turn_length] = friction;
  auto& [kind, coulomb, static_level, viscous_s_per_m, stribeck_velocity_m_per_s, stribeck_exponent,
         stiffness_N_per_m, damping_s_per_m, damping_fade_m_per_s, stick_velocity_m_per_s,
         elastic_fraction] = model;
  archive.choice(kind, static_cast<FrictionKind>(rendering::kFrictionKinds - 1));
  archive(coulomb, static_level, viscous_s_per_m, stribeck_velocity_m_per_s, stribeck_exponent,
          stiffness_N_per_m, damping_s_per_m, damping_fade_m_per_s, stick_velocity_m_per_s,
          elastic_fraction, compensated_share, turn_length);
}

inline void transfer(StateArchive& archive, SafetyConfig& safety) {
  auto& [max_force_N, force_slew_N_per_s, soft_start_s, contact_start_s, max_sample_age_us,
         stale_ticks_to_fault, late_ticks_to_fault, max_tick_gap_s, max_joint_speed, frozen_travel,
         blocked_effort_share, blocked_s, sign_check_N, moving_mass_kg, max_tool_speed_m_per_s,
         runaway_speed_m_per_s, runaway_travel_m, workspace_lower_W, workspace_upper_W,
         workspace_stiffness_N_per_m, workspace_damping_Ns_per_m, workspace_overrun_m,
         device_delay_s, device_damping_Ns_per_m, passivity_damping_Ns_per_m,
         passivity_fault_travel_m, guards_off] = safety;
  archive(max_force_N, force_slew_N_per_s, soft_start_s, contact_start_s, max_sample_age_us,
          stale_ticks_to_fault, late_ticks_to_fault, max_tick_gap_s, max_joint_speed, frozen_travel,
          blocked_effort_share, blocked_s, sign_check_N, moving_mass_kg, max_tool_speed_m_per_s,
          runaway_speed_m_per_s, runaway_travel_m, workspace_lower_W, workspace_upper_W,
          workspace_stiffness_N_per_m, workspace_damping_Ns_per_m, workspace_overrun_m,
          device_delay_s, device_damping_Ns_per_m, passivity_damping_Ns_per_m,
          passivity_fault_travel_m, guards_off);
}

inline void transfer(StateArchive& archive, CertifiedPoint& point) {
  auto& [damping_Ns_per_m, stiffness_N_per_m] = point;
  archive(damping_Ns_per_m, stiffness_N_per_m);
}

inline void transfer(StateArchive& archive, StiffnessCertificate& certificate) {
  auto& [points, count, margin] = certificate;
  archive.up_to(count, kMaxCertifiedPoints);
  archive(points, margin);
}

inline void transfer(StateArchive& archive, ControllerConfig& config) {
  auto& [rate_hz, tick_instructions, mechanism, workspace_origin_D, gravity_D, velocity_cutoff_hz,
         joints, coupled_limits, friction, safety, certificate, allow_uncertified, on_fault] =
      config;
  archive.same(kConfigVersion);
  transfer(archive, mechanism);
  archive(rate_hz, tick_instructions, workspace_origin_D, gravity_D, velocity_cutoff_hz, joints,
          coupled_limits, friction, safety, certificate, allow_uncertified);
  archive.choice(on_fault, OnFault::own);
}

std::size_t save_config(const ControllerConfig& config,
                        std::span<std::byte, kMaxConfigBytes> room) {
  ControllerConfig copy = config;
  StateArchive archive = StateArchive::writer(room);
  archive(copy);
  return archive.good() ? archive.size() : 0;
}

bool read_config(std::span<const std::byte> bytes, ControllerConfig& config) {
  StateArchive archive = StateArchive::reader(bytes);
  archive(config);
  const bool good = archive.good() && archive.at_end();
  if (!good) {
    config = {};
  }
  return good;
}

}  // namespace tactus::firmware
