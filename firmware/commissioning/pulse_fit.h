// Estimates inertia, friction and delay of a joint from its answer to a pulse of effort.
//
// The joint is at rest, the handle free. Its motion obeys
//   M q'' = u(t - d) - b q' - F sign(q') + g
// with the apparent inertia M, viscous friction b, sliding friction F, a constant load g (weight)
// and the delay d of commands. Integrated twice this is linear in M, b, F and g and needs positions
// only, so that an encoder's counts do no harm:
//   M (q - q0) + b S(q - q0) + F SS sign(q') - g t^2 / 2 = SS u(t - d)
// where S is the integral from the start. Least squares gives the four numbers, and the delay with
// the smallest residual is taken (Swevers, Verdonck and De Schutter 2007 use the same linear form
// for robots).
#pragma once

#include <array>
#include <cstddef>

namespace tactus::firmware {

inline constexpr std::size_t kMaxPulseSamples = 1024;
inline constexpr std::size_t kMaxPulseDelay = 12;  // ticks

// Positions (rad or m) and the efforts (N m or N) commanded after each, one per tick.
struct PulseRecord {
  std::array<double, kMaxPulseSamples> position{};
  std::array<double, kMaxPulseSamples> effort{};
  // The effort that the drive reports; valid if has_reported.
  std::array<double, kMaxPulseSamples> reported{};
  std::size_t count = 0;
  bool has_reported = false;
};

struct PulseFit {
  // Apparent inertia at the joint, kg m^2 or kg. It is below 0 if the joint moves against its
  // effort.
  double inertia = 0.0;
  double viscous = 0.0;   // N m s/rad or N s/m
  double friction = 0.0;  // N m or N
  double load = 0.0;      // N m or N, along positive positions
  std::size_t delay_ticks = 0;
  // Share of the effort's double integral that the fit explains, at most 1.
  double explained = 0.0;
  // Ratio of reported to commanded effort, by least squares at the best shift; 0 without reports.
  double reported_share = 0.0;
  double travel = 0.0;   // largest distance from the start, rad or m
  double quantum = 0.0;  // smallest step of the position that was seen, rad or m
};

// Returns the fit of a record. `step_s` is the time between samples. A record without motion gives
// zeros.
PulseFit fit_pulse(const PulseRecord& record, double step_s);

}  // namespace tactus::firmware
