#include "firmware/safety/passivity.h"

#include <algorithm>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// The time constant with which a debt decays.
constexpr double kForgetting_s = 1.0;
// Peaks below this share of max_force_N do not count as a buzz.
constexpr double kWeakestBuzz = 0.05;

}  // namespace

void PassivityControl::configure(const ControllerConfig& config) {
  step_s_ = 1.0 / config.rate_hz;
  device_damping_Ns_per_m_ = config.safety.device_damping_Ns_per_m;
  max_damping_Ns_per_m_ = config.safety.passivity_damping_Ns_per_m;
  fault_J_ = config.safety.max_force_N * config.safety.passivity_fault_travel_m;
  buzz_.configure(kWeakestBuzz * config.safety.max_force_N);
  restart();
}

void PassivityControl::restart() {
  credit_J_ = 0.0;
  buzz_.restart();
}

std::uint64_t PassivityControl::observe(const TickEnergy& energy, bool in_contact) {
  // Only a debt is forgotten. A credit ends with the contact.
  if (credit_J_ < 0.0) {
    credit_J_ -= std::min(1.0, energy.step_s / kForgetting_s) * credit_J_;
  }
  credit_J_ += device_damping_Ns_per_m_ * energy.way_m2 / energy.step_s - energy.passive_J;
  if (!in_contact) {
    credit_J_ = std::min(credit_J_, 0.0);
  }
  const bool buzzes = buzz_.observe(energy.contact_N, energy.step_s) && credit_J_ < 0.0;
  return buzzes || credit_J_ < -fault_J_ ? kFaultNotPassive : kNoFault;
}

Vec3 PassivityControl::damp_W(const Vec3& v_W, bool in_contact) const {
  const double size = step_s_ * v_W.squaredNorm();
  if (!in_contact || credit_J_ >= 0.0 || !(size > 0.0)) {
    return Vec3::Zero();
  }
  return -std::min(-credit_J_ / size, max_damping_Ns_per_m_) * v_W;
}

}  // namespace tactus::firmware
