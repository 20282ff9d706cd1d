// Saves and restores the controller's memory (see rendering/state_archive.h). Configuration
// and scene are not part of it. A function that names all members of its class does not compile
// with a new member until it is decided whether that member is saved.
#include <bit>

#include "firmware/control/controller.h"
#include "rendering/state/plain_states.h"

namespace tactus::firmware {
namespace {

using rendering::StateArchive;

// The bytes "TACTUS09" with which a state begins. A change of the format gets another last digit.
constexpr std::uint64_t kMagic = 0x3930'5355'5443'4154U;

}  // namespace

void VelocityFilter::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [share, state] = *this;
  archive(state);
}

void SampleCheck::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [joint_count, limits, coupled_limits, max_age_us, stale_ticks_to_fault,
                          stale_in_a_row, stale_count] = *this;
  archive(stale_in_a_row, stale_count);
}

void LoopCheck::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [late_ticks_to_fault, missed_ticks_to_fault, late_in_a_row, late_count] =
      *this;
  archive(late_in_a_row, late_count);
}

void EncoderGuard::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [joints, joint_count, step_s, max_step, frozen_travel,
                          blocked_ticks_to_fault, passed_ticks, is_placed] = *this;
  for (Joint& joint : joints) {
    [[maybe_unused]] auto& [position, travel, effort, blocked_step, blocked_ticks] = joint;
    archive(position, travel, effort, blocked_ticks);
  }
  archive(passed_ticks, is_placed);
}

void EffortGuard::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [joints, joint_count, step_s, motion_share, effort_share,
                          wrong_ticks_to_fault, late_ticks, span_ticks] = *this;
  for (Joint& joint : joints) {
    [[maybe_unused]] auto& [force_N, speed_m_per_s, growth, commanded, held_now, held_before,
                            distance, largest, unmeasured_ticks, wrong_ticks] = joint;
    archive(force_N, speed_m_per_s, growth, commanded, held_now.least, held_now.most,
            held_before.least, held_before.most, distance, unmeasured_ticks, wrong_ticks);
  }
  archive.up_to(span_ticks, late_ticks);
}

// Bounds the numbers that index arrays, because a damaged file may hold anything.
void MotorSignCheck::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [settings, shape, tables, joints, unanswered, asked, ticks_to_wait, pulse,
                          most_gain, push] = *this;
  for (Joint& joint : joints) {
    auto& [force_N, right, wrong, strong, unclear] = joint;
    archive(force_N, right, wrong, strong, unclear);
  }
  auto& [is_running, ticks, start, effort_sum, efforts, effort_integral, effort_double_integral,
         amplitude, sums] = pulse;
  archive(unanswered);
  archive.up_to(asked, settings.joint_count - 1);
  archive(is_running, ticks_to_wait);
  archive.up_to(ticks, static_cast<std::uint32_t>(shape.ticks() - 1));
  auto& [y_powers, r_powers, z_y, z_r, y_y, y_r, r_r] = sums;
  archive(start, effort_sum, efforts, effort_integral, effort_double_integral, amplitude, most_gain,
          y_powers, r_powers, z_y, z_r, y_y, y_r, r_r, push);
}

void MotionGuard::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [step_s, max_speed_m_per_s, runaway_speed_m_per_s, runaway_travel_m,
                          runaway_m] = *this;
  archive(runaway_m);
}

void HeldForces::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [ring, newest, whole, share] = *this;
  for (HeldForce& force : ring) {
    auto& [all_W, rendered_W, effect_W] = force;
    archive(all_W, rendered_W, effect_W);
  }
  archive.up_to(newest, kMost);
}

void EnergyAccount::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [tick_s, held, ledger_J, parts, rendered_W, p_W, is_placed] = *this;
  auto& [friction_W, texture_W, effect_W, driven_power] = parts;
  archive(held, ledger_J, friction_W, texture_W, effect_W, driven_power, rendered_W, p_W,
          is_placed);
}

void PassivityControl::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [step_s, device_damping_Ns_per_m, max_damping_Ns_per_m, fault_J, credit_J,
                          buzz] = *this;
  archive(credit_J, buzz);
}

void BuzzDetector::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [weakest_peak_N, first_peak_N, extreme_N, since_peak_s, peaks, is_rising] =
      *this;
  archive(first_peak_N, extreme_N, since_peak_s, peaks, is_rising);
}

void ForceLimiter::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [wanted_max_force_N, max_force_N, max_step_N, activation_gain_per_tick,
                          contact_gain_per_tick, activation_gain, contact_gain, touched, last_W] =
      *this;
  archive(max_force_N, activation_gain, contact_gain, touched, last_W);
}

void GravityCompensation::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [is_on, gain_per_tick, gain, gravity_D, limits] = *this;
  archive(gain);
}

void FrictionCompensation::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [is_on, joint_count, step_s, gain_per_tick, gain, velocity_filter,
                          is_placed, last_position, joints, limits] = *this;
  archive(gain, velocity_filter, is_placed, last_position);
  for (Joint& joint : joints) {
    archive(joint.memory);
  }
}

// The order of the members is the order of the format.
void DeviceController::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [settings, next, modes, guards, locator, force_path, effort_path, record,
                          in_progress, now_ns, watcher] = *this;
  [[maybe_unused]] auto& [config, configured_safety, is_configured] = settings;
  [[maybe_unused]] auto& [number, loop_report, write_status, change, held_effort] = next;
  [[maybe_unused]] auto& [loop, sample, encoders, walls, motion, efforts, signs] = guards;
  [[maybe_unused]] auto& [mechanism, velocity_filter, origin_D, pose, tool] = locator;
  auto& [energy, passivity, limiter] = force_path;
  [[maybe_unused]] auto& [gravity, friction, limits] = effort_path;
  archive.same(std::bit_cast<std::uint64_t>(config.rate_hz));
  archive.same(joint_count(config.mechanism));
  archive.require(is_configured);
  archive(sample, loop, loop_report.status, loop_report.missed_ticks, velocity_filter, limiter,
          gravity, friction, modes, write_status, tool, number);
  archive(encoders, efforts, signs, motion, energy, passivity, held_effort);
  transfer_parameters(archive);
  transfer_pose(archive);
  transfer_record(archive);
}

// Transfers the values that set_parameter can change.
void DeviceController::transfer_parameters(StateArchive& archive) {
  auto& [place, value] = next_.change;
  ControllerConfig& config = settings_.config;
  SafetyConfig& safety = config.safety;
  archive.choice(place.parameter, kLastParameter);
  archive(place.object, value, safety.max_force_N, safety.force_slew_N_per_s, safety.soft_start_s,
          safety.contact_start_s, config.velocity_cutoff_hz);
  if (archive.is_reading()) {
    archive.require(validate(config).has_value());
    retune();
  }
}

void DeviceController::transfer_pose(StateArchive& archive) {
  auto& [p_D, jacobian_D, status] = locator_.pose;
  archive(p_D, jacobian_D, status);
}

// Transfers the fields of the record that the next tick uses.
void DeviceController::transfer_record(StateArchive& archive) {
  auto& [stale_samples, faults_entered, limited_ticks, touch_flagged, late_ticks] =
      record_.counters;
  archive(stale_samples, faults_entered, limited_ticks, touch_flagged, late_ticks,
          record_.state_hash);
}

// The devices, then what they share.
void Controller::transfer(StateArchive& archive) {
  [[maybe_unused]] auto& [first_device, more_devices, scene] = *this;
  [[maybe_unused]] auto& [world, changes, objects, effects, needle, tool_radius_m, standing_units,
                          refused_part] = scene;
  archive.same(kMagic);
  for (std::size_t i = 0; i < device_count(); ++i) {
    archive(at(i));
  }
  archive(world);
  changes.transfer(archive, world);
}

std::size_t Controller::save(std::span<std::byte> room) {
  StateArchive archive = StateArchive::writer(room);
  transfer(archive);
  return archive.good() ? archive.size() : 0;
}

bool Controller::restore(std::span<const std::byte> bytes) {
  StateArchive archive = StateArchive::reader(bytes);
  transfer(archive);
  if (archive.good() && archive.at_end()) {
    return true;
  }
  // Clear everything that the refused bytes set: an empty archive reads zeros.
  StateArchive nothing = StateArchive::reader({});
  transfer(nothing);
  for (std::size_t i = 0; i < device_count(); ++i) {
    at(i).forget_configuration();
  }
  return false;
}

}  // namespace tactus::firmware
