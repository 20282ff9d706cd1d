// Time-domain passivity observer and controller, in the impedance form: B. Hannaford and J.-H. Ryu,
// "Time-Domain Passivity Control of Haptic Interfaces", IEEE Transactions on Robotics and
// Automation 18(1), 2002. Surfaces of any material give the hand no more energy than it has given
// them. If sampling, delay or a badly made scene gives more, a damper takes it back. One thread;
// real time.
//
//   observer    E += -E_held + b |dx|^2 / T    energy that the hand has given and not got back, J
//   controller  F = -a v, a = min(-E / (T |v|^2), passivity_damping), while E < 0
//
// In the observer T is the time since the previous tick, with the missed ticks; in the controller
// it is the period, for which the damper's force will be held. E_held is the energy that the force
// of the past tick gave over the motion dx of the same tick, including the damper's force
// (safety/energy_account.h). The force of this tick must not be paired with that motion: that hides
// the energy which holding the force makes. b is the least damping of the device without a hand;
// the device itself dissipates that energy.
//
// Contact begins without credit: energy given in one touch does not pay for the next (the paper's
// reset, section V). A debt is paid in contact only, so that the tool never drags in free space. It
// decays with a time constant of a second, because encoder steps make a small debt in every long
// touch. Any debt while the contact buzzes is a fault.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "firmware/safety/buzz_detector.h"
#include "firmware/safety/energy_account.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The observer and the damper of one tool.
class PassivityControl {
 public:
  // Takes rate, dampings and threshold, and restarts.
  void configure(const ControllerConfig& config);

  // Sets the credit to 0. Call at activation.
  void restart();

  // Adds the energy of the past tick. Call before damp_W. Returns kFaultNotPassive if the contact
  // buzzes with a debt, or if the debt is above max_force_N times passivity_fault_travel_m.
  std::uint64_t observe(const TickEnergy& energy, bool in_contact);

  // Returns the damper's force, N, to be added to the rendered force; zero without contact or
  // debt. The velocity is finite, m/s.
  [[nodiscard]] Vec3 damp_W(const Vec3& v_W, bool in_contact) const;

  // Returns E, J. A negative value is a debt.
  [[nodiscard]] double credit_J() const { return credit_J_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // The period of the ticks, s.
  double step_s_ = 0.001;
  double device_damping_Ns_per_m_ = 0.0;
  double max_damping_Ns_per_m_ = 0.0;
  // A debt above this is a fault, J.
  double fault_J_ = 0.0;
  // E, J.
  double credit_J_ = 0.0;
  BuzzDetector buzz_;
};

}  // namespace tactus::firmware
