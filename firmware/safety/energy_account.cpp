#include "firmware/safety/energy_account.h"

#include <algorithm>
#include <array>

namespace tactus::firmware {
namespace {

// Returns the ledger's entry of a source.
double& entry(EnergyLedger& ledger, EnergySource source) {
  return ledger[static_cast<std::size_t>(source)];
}

// Returns c, the share of the rendered force that is held, by least squares; in [0, 1].
double share_of(const Vec3& held, const Vec3& rendered) {
  const double size = rendered.squaredNorm();
  return size > 0.0 ? std::clamp(held.dot(rendered) / size, 0.0, 1.0) : 1.0;
}

// Returns the contact's part of the rendered force, N.
Vec3 contact_of(const rendering::Touch& touch) {
  const rendering::ForceParts& parts = touch.parts;
  return touch.force_W - parts.friction_W - parts.texture_W - parts.effect_W;
}

// Returns the number of ticks, at least 1, bounded by the memory of the held forces.
std::size_t ticks_of(double ticks) {
  return static_cast<std::size_t>(
      std::clamp(ticks + 0.5, 1.0, static_cast<double>(HeldForces::kMost)));
}

EnergySource source_at(const double* entry, const double* first) {
  return static_cast<EnergySource>(entry - first);
}

}  // namespace

void EnergyAccount::configure(const ControllerConfig& config) {
  tick_s_ = 1.0 / config.rate_hz;
  held_.configure(config.safety.device_delay_s * config.rate_hz);
  restart();
}

void EnergyAccount::restart() {
  held_.restart();
  ledger_J_ = {};
  parts_ = {};
  rendered_W_ = Vec3::Zero();
  p_W_ = Vec3::Zero();
  is_placed_ = false;
}

TickEnergy EnergyAccount::settle(const Vec3& p_W, const rendering::Touch& touch, double step_s) {
  TickEnergy tick;
  if (is_placed_) {
    const double share = share_of(held_W(), rendered_W_);
    const HeldForce acting = held_.acting_over(ticks_of(step_s / tick_s_));
    const Vec3 way = p_W - p_W_;
    // Half of the motion, times the share: the factor of the sums of two ticks' forces below.
    const Vec3 half_way = 0.5 * share * way;
    const rendering::ForceParts& parts = touch.parts;
    const double all_J = (rendered_W_ + touch.force_W).dot(half_way);
    const double friction_J = (parts_.friction_W + parts.friction_W).dot(half_way);
    const double texture_J = (parts_.texture_W + parts.texture_W).dot(half_way);
    const double effect_J = (parts_.effect_W + parts.effect_W).dot(half_way);
    // driven_power is the power that the surfaces' own motion gives, so its energy is the mean over
    // the tick.
    const double coupling_J = 0.5 * share * step_s * (parts_.driven_power + parts.driven_power);
    const double held_J = acting.rendered_W.dot(way);
    tick.given_J = acting.all_W.dot(way);
    tick.passive_J = tick.given_J - acting.effect_W.dot(way) - coupling_J;
    tick.way_m2 = way.squaredNorm();
    using enum EnergySource;
    entry(ledger_J_, contact) += all_J - friction_J - texture_J - effect_J - coupling_J;
    entry(ledger_J_, friction) += friction_J;
    entry(ledger_J_, texture) += texture_J;
    entry(ledger_J_, effect) += effect_J;
    entry(ledger_J_, coupling) += coupling_J;
    entry(ledger_J_, safety) += tick.given_J - held_J;
    entry(ledger_J_, delay) += held_J - all_J;
  }
  tick.contact_N = contact_of(touch).norm();
  tick.step_s = step_s;
  parts_ = touch.parts;
  rendered_W_ = touch.force_W;
  p_W_ = p_W;
  is_placed_ = true;
  return tick;
}

void EnergyAccount::hold(const Vec3& force_W) {
  const double share = share_of(force_W, rendered_W_);
  held_.push(
      {.all_W = force_W, .rendered_W = share * rendered_W_, .effect_W = share * parts_.effect_W});
}

EnergySource EnergyAccount::most_giving() const {
  return source_at(std::ranges::max_element(ledger_J_), ledger_J_.data());
}

EnergySource strongest_part(const rendering::Touch& touch, const Vec3& added_W) {
  const rendering::ForceParts& parts = touch.parts;
  // In the order of EnergySource; coupling has no force of its own.
  const std::array<double, 6> sizes = {contact_of(touch).squaredNorm(),
                                       parts.friction_W.squaredNorm(),
                                       parts.texture_W.squaredNorm(),
                                       parts.effect_W.squaredNorm(),
                                       0.0,
                                       added_W.squaredNorm()};
  return source_at(std::ranges::max_element(sizes), sizes.data());
}

}  // namespace tactus::firmware
