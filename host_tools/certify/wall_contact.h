// Decides whether a hand that is pressed against a virtual wall comes to rest: one contact of the
// simulated device with the real controller, and the verdict on it.
//
// The trial: a guide moves the handle at a steady speed v0 onto the wall and into it, to the depth
// at which the wall carries the press F, and lets go there. From then on the hand presses with F. A
// hand that is "off" has no mass, spring or damper, only the press. v0 is 0.7 of the speed that
// would carry the handle out of the wall if nothing took energy away; so a stable contact stays a
// contact, and an unstable one starts near its largest oscillation.
//
// The verdict: after one period of the handle on the ideal wall, 2 pi sqrt(M / (K + k_hand)), five
// windows follow, each of four periods but at least 0.15 s. The motion of a window is its mean
// kinetic energy, weighted with a Hann window, so that the phase at which the window begins does
// not matter.
//
// - The contact is stable if the motion decreases from window to window until the last, or if the
// rms speed over one period (at least 0.1 s) falls below 1 mm/s, which counts as quiet.
// - It is unstable as soon as a window has at least 99.9 % of the motion of the one before: growth,
// a limit cycle, or chatter that the hand feels. A fault of the controller is unstable too.
//
// The limit of 1 mm/s follows from the skin's thresholds for vibration, some 10 um at 40 Hz, 1 um
// at 100 Hz and 0.2 um at 250 Hz: as speeds they all lie between a few tenths of a millimetre a
// second and a few.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "firmware/control/controller.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/simulated_device.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// Motion below this rms speed cannot be felt.
inline constexpr double kQuietSpeed_m_per_s = 1e-3;

// The hand, the device, and the place at which the wall is touched.
struct WallContact {
  DeviceParameters device;
  // The controller's configuration; its workspace origin is moved to the contact.
  firmware::ControllerConfig controller;
  // All zero: off. Its tremor is left out.
  HandParameters hand;
  // A point of the wall's surface in the device's base frame, m.
  Vec3 point_B = Vec3::Zero();
  // The wall's unit normal, out of the wall.
  Vec3 normal_B = Vec3::UnitX();
  // The force with which the hand presses.
  double press_N = 2.0;
};

// The stiffness K and the damping B of a wall.
struct WallStiffness {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
};

// How a trial ended; the file's head defines the words.
enum class ContactVerdict : std::uint8_t { quiet, settling, sustained, fault };

// Returns true if the contact came to rest or was on the way there.
constexpr bool is_stable(ContactVerdict verdict) {
  return verdict == ContactVerdict::quiet || verdict == ContactVerdict::settling;
}

// Runs trials. It holds the controller, two megabytes, from trial to trial; a trial does not
// depend on those before. Deterministic; one thread.
class ContactTrial {
 public:
  ContactTrial() : setup_(std::make_unique<Setup>()) {}

  // Tries one wall. Throws InputError if the device or the controller refuses its configuration.
  ContactVerdict run(const WallContact& contact, const WallStiffness& wall);

 private:
  // The wall, to which the controller refers until the next trial, and the controller.
  struct Setup {
    std::array<rendering::Object, 1> wall;
    firmware::Controller controller;
  };
  std::unique_ptr<Setup> setup_;
};

}  // namespace tactus::host
