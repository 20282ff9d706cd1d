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

// The longest record in ticks: 1 s at 1 kHz.
inline constexpr std::size_t kMaxPulseSamples = 1024;
// The largest delay that is tried, ticks.
inline constexpr std::size_t kMaxPulseDelay = 12;

// A record of a pulse, one entry a tick: positions, rad or m, and the efforts, N m or N, that were
// commanded after each position.
struct PulseRecord {
  // The position, and the effort that was commanded after it.
  std::array<double, kMaxPulseSamples> position{};
  std::array<double, kMaxPulseSamples> effort{};
  // The efforts that the drive reported with each position; valid if has_reported.
  std::array<double, kMaxPulseSamples> reported{};
  // The number of entries.
  std::size_t count = 0;
  bool has_reported = false;
};

// The result of a fit. All are 0 for a record without motion.
struct PulseFit {
  // Apparent inertia at the joint, kg m^2 or kg. It is below 0 if the joint moves against its
  // effort.
  double inertia = 0.0;
  // Viscous friction, N m s/rad or N s/m.
  double viscous = 0.0;
  // Sliding friction, N m or N.
  double friction = 0.0;
  // Constant load, such as a weight, N m or N, along positive positions.
  double load = 0.0;
  // The delay of commands, ticks.
  std::size_t delay_ticks = 0;
  // The share of the effort's double integral that the fit explains, at most 1. A hand at the
  // handle makes it small.
  double explained = 0.0;
  // Ratio of reported to commanded effort, by least squares at the best shift; 0 without reports.
  double reported_share = 0.0;
  // The largest distance from the start, rad or m.
  double travel = 0.0;
  // The smallest step of the position that was seen, rad or m: a count of the encoder.
  double quantum = 0.0;
};

// Returns the fit of a record. `step_s` is the time between samples, s. A pure function for any
// thread; it solves kMaxPulseDelay + 1 systems over the record, so it is for the end of a pulse.
PulseFit fit_pulse(const PulseRecord& record, double step_s);

}  // namespace tactus::firmware
