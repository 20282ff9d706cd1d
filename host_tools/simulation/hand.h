// The simulated hand of an operator: a mass on the handle, tied by a spring and a damper to a
// wished position that follows a path and trembles. It does not react to forces; it only yields to
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/simulation/wish_path.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {

// The impedance of the hand at the handle, alike in all directions.
struct HandParameters {
  double mass_kg = 0.0;
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
  // The largest tremor of each axis, m.
  double tremor_m = 0.0;
};

// Values within the range usually quoted for a fingertip (Hajian and Howe, 1997) and for a stylus
// grip. None was measured on one person.
inline constexpr HandParameters kFingerHand{
    .mass_kg = 0.006, .damping_Ns_per_m = 4.0, .stiffness_N_per_m = 400.0, .tremor_m = 100e-6};
inline constexpr HandParameters kPenHand{
    .mass_kg = 0.1, .damping_Ns_per_m = 5.0, .stiffness_N_per_m = 300.0, .tremor_m = 100e-6};
inline constexpr HandParameters kFirmHand{
    .mass_kg = 0.15, .damping_Ns_per_m = 10.0, .stiffness_N_per_m = 1000.0, .tremor_m = 50e-6};

// Returns the hand named "finger", "pen" or "firm"; nothing for any other name.
std::optional<HandParameters> hand_preset(std::string_view name);

// Physiological tremor: on each axis the sum of four sinusoids between 8 and 12 Hz, whose
// frequencies and phases follow from the seed. It rotates phasors, so no transcendental function is
// evaluated after construction, and the result is the same on every processor.
class Tremor {
 public:
  // `amplitude_m` bounds the offset of each axis.
  Tremor(double amplitude_m, std::uint64_t seed, double tick_s);

  // Returns the offset from the path now, m.
  [[nodiscard]] Vec3 offset() const;
  // Advances by one tick.
  void advance();

 private:
  static constexpr std::size_t kComponentsPerAxis = 4;
  // A point on the unit circle and the rotation of one tick.
  struct Phasor {
    double cos = 1.0;
    double sin = 0.0;
    double turn_cos = 1.0;
    double turn_sin = 0.0;
  };
  std::array<Phasor, 3 * kComponentsPerAxis> phasors_{};
  // The amplitude of one sinusoid, m.
  double component_m_ = 0.0;
};

// A hand that follows a path. The simulation asks for the wished positions at both ends of a tick.
class Hand {
 public:
  // Places the wish at the beginning of `path`; `seed` chooses the tremor.
  Hand(const HandParameters& parameters, WishPath path, std::uint64_t seed, double tick_s);

  [[nodiscard]] const HandParameters& parameters() const { return parameters_; }
  // Returns the wished position now, m, world frame, tremor included.
  [[nodiscard]] const Vec3& wish_W() const { return wish_W_; }
  // Returns the wished position one tick later, m, world frame.
  [[nodiscard]] const Vec3& next_wish_W() const { return next_wish_W_; }
  // Advances by one tick.
  void advance();

 private:
  HandParameters parameters_;
  WishPath path_;
  Tremor tremor_;
  double tick_s_;
  std::uint64_t tick_ = 0;
  Vec3 wish_W_ = Vec3::Zero();
  Vec3 next_wish_W_ = Vec3::Zero();
};

}  // namespace tactus::host
