// The simulated hand: a mass on the handle, tied by a spring and a damper to a wish that follows a
// path and trembles.
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

struct HandParameters {
  double mass_kg = 0.0;
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
  // The tremor of each axis never exceeds this, m.
  double tremor_m = 0.0;
};

// Values within the range usually quoted for a fingertip (Hajian and Howe 1997) and for a stylus
// grip; none is a measurement of one person.
inline constexpr HandParameters kFingerHand{
    .mass_kg = 0.006, .damping_Ns_per_m = 4.0, .stiffness_N_per_m = 400.0, .tremor_m = 100e-6};
inline constexpr HandParameters kPenHand{
    .mass_kg = 0.1, .damping_Ns_per_m = 5.0, .stiffness_N_per_m = 300.0, .tremor_m = 100e-6};
inline constexpr HandParameters kFirmHand{
    .mass_kg = 0.15, .damping_Ns_per_m = 10.0, .stiffness_N_per_m = 1000.0, .tremor_m = 50e-6};

// "finger", "pen" or "firm".
std::optional<HandParameters> hand_preset(std::string_view name);

// Physiological tremor: a few sinusoids between 8 and 12 Hz on each axis, with frequencies and
// phases from the seed. Advanced by turning phasors: no transcendental function after construction.
class Tremor {
 public:
  Tremor(double amplitude_m, std::uint64_t seed, double tick_s);

  [[nodiscard]] Vec3 offset() const;  // m
  void advance();                     // one tick

 private:
  static constexpr std::size_t kComponentsPerAxis = 4;
  struct Phasor {
    double cos = 1.0;
    double sin = 0.0;
    double turn_cos = 1.0;
    double turn_sin = 0.0;
  };
  std::array<Phasor, 3 * kComponentsPerAxis> phasors_{};
  double component_m_ = 0.0;
};

class Hand {
 public:
  Hand(const HandParameters& parameters, WishPath path, std::uint64_t seed, double tick_s);

  [[nodiscard]] const HandParameters& parameters() const { return parameters_; }
  [[nodiscard]] const Vec3& wish_W() const { return wish_W_; }            // m, now
  [[nodiscard]] const Vec3& next_wish_W() const { return next_wish_W_; }  // m, one tick on
  void advance();                                                         // one tick

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
