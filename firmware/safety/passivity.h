// Time-domain passivity observer and controller, in the impedance form: B. Hannaford and J.-H. Ryu,
// "Time-Domain Passivity Control of Haptic Interfaces", IEEE Transactions on Robotics and
// Automation 18(1), 2002. Whatever the surfaces are made of, they give the hand no energy that it
// has not given them: what sampling, delay or a badly made scene gives beyond that is taken back by
// a damper that is there for as long as it is needed.
//
//  observer    E += -E_held + b |way|^2 / T    J the hand has given and not got back
//  controller  F = -a v, a = min(-E / (T |v|^2), passivity_damping), while E < 0
//
// E_held is what the force of the past tick gave over the way of that same tick, the damper's
// included (safety/energy_account.h). Pairing the force of this tick with that way, as a first
// sketch would, hides just the energy that holding the force makes. b is the damping that the
// device has at least, without a hand: that much of the way's energy it takes itself.
//
// Contact begins without credit: what the hand gave in one touch does not pay for the next (the
// paper's reset, section V). A debt is paid in contact only, for nothing drags in the air, and is
// forgotten with a time constant of a second: an encoder's steps make a small one in every long
// touch. A debt while the contact buzzes is a fault however small it is.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/buzz_detector.h"
#include "firmware/safety/energy_account.h"
#include "rendering/geometry/vector.h"
#include "rendering/state/state_archive.h"

namespace tactus::firmware {

class PassivityControl {
 public:
  void configure(const ControllerConfig& config);

  // Activation: nobody owes anything.
  void restart();

  // First in a tick. kFaultNotPassive when the contact buzzes, or the debt is
  // beyond max_force_N times passivity_fault_travel_m.
  std::uint64_t observe(const TickEnergy& energy, bool in_contact);

  // N, to be added to the force; zero out of contact and without debt. The velocity is finite.
  [[nodiscard]] Vec3 damp_W(const Vec3& v_W, bool in_contact) const;

  // E; below 0 it is a debt.
  [[nodiscard]] double credit_J() const { return credit_J_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double step_s_ = 0.001;
  double device_damping_Ns_per_m_ = 0.0;
  double max_damping_Ns_per_m_ = 0.0;
  double fault_J_ = 0.0;
  double credit_J_ = 0.0;
  BuzzDetector buzz_;
};

}  // namespace tactus::firmware
