// Decides whether a hand pressed against a virtual wall comes to rest: one contact of the simulated
// device with the real controller, and the verdict on it.
//
// The trial. A guide takes the handle at a steady speed onto the wall and into it, to the depth
// where the wall carries the press F, and lets go there. What holds it from then on is the hand,
// which presses with F; a hand that is off has no mass, spring or damper, only the press. The speed
// v0 is 0.7 of what would carry the handle back out of the wall if nothing took energy away, so a
// stable contact stays a contact, and an unstable one starts near its largest.
//
// The verdict. After one period of the handle on the ideal wall, 2 pi sqrt(M / (K + k_hand)), five
// windows follow, each of four periods but at least 0.15 s. The motion of a window is its mean
// kinetic energy, weighted with a Hann window, so that it does not matter at which phase of the
// oscillation a window begins. The contact is stable if the motion gets less from window to window
// until the last, or until the speed of one period, but at least 0.1 s, is below 1 mm/s rms, which
// is quiet. It is unstable as soon as a window has as much motion as the one before, less 0.1
// percent: growth, a limit cycle, or chatter that the hand feels. A fault of the controller is
// unstable too.
//
// The limit of 1 mm/s has this reason: the skin's thresholds for vibration, some 10 um at 40 Hz, 1
// um at 100 Hz and 0.2 um at 250 Hz, all are a few tenths of a millimetre a second to a few.
#pragma once

#include <cstdint>
#include <memory>

#include "firmware/control/controller.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/simulated_device.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

inline constexpr double kQuietSpeed_m_per_s = 1e-3;

// The hand, the device and the place at which the wall is touched.
struct WallContact {
  DeviceParameters device;
  firmware::ControllerConfig controller;  // its origin is moved to the contact
  HandParameters hand;                    // all zero: off; its tremor is left out
  Vec3 point_B = Vec3::Zero();            // m, of the wall's surface
  Vec3 normal_B = Vec3::UnitX();          // unit, out of the wall
  double press_N = 2.0;
};

// The stiffness K and the damping B of the wall.
struct WallStiffness {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

enum class ContactVerdict : std::uint8_t { quiet, settling, sustained, fault };

constexpr bool is_stable(ContactVerdict verdict) {
  return verdict == ContactVerdict::quiet || verdict == ContactVerdict::settling;
}

// Holds the controller, half a megabyte, from trial to trial. One thread. Deterministic: a trial
// does not depend on those before.
class ContactTrial {
 public:
  ContactTrial() : controller_(std::make_unique<firmware::Controller>()) {}

  // Throws InputError when device or controller refuse their configuration.
  ContactVerdict run(const WallContact& contact, const WallStiffness& wall);

 private:
  std::unique_ptr<firmware::Controller> controller_;
};

}  // namespace tactus::host
