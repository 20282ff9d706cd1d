// One pulse of the motor sign check: its shape, the tables that belong to the shape, the sums over
// its samples, and the estimate from them. motor_sign_check.h has the derivation. One thread; real
// time, except pulse_tables().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus::firmware {

// The largest number of samples of a pulse.
inline constexpr std::size_t kMaxSignSamples = 80;
// The number of powers of time that are projected out: 0 to 5.
inline constexpr std::size_t kPulsePowers = 6;
// The largest delay in units. A longer one is cut to it.
inline constexpr std::size_t kMaxSignDelay = 7;

// The shape of every pulse of a device. A unit is a whole number of ticks, about a millisecond.
struct PulseShape {
  double unit_s = 0.001;
  std::uint32_t ticks_a_unit = 1;
  // The length of T in units.
  std::size_t quarter = 6;
  // The configured delay in units.
  std::size_t delay = 0;
  // The number of samples of a pulse.
  std::size_t samples = 0;

  // Returns the sign of the pulse in that unit: 1, -1, or 0 after its end.
  [[nodiscard]] double sign_in(std::size_t unit) const;
  // Returns the number of ticks of a pulse.
  [[nodiscard]] std::size_t ticks() const { return (samples - 1) * ticks_a_unit; }
};

// Returns the shape for a loop rate and the device's delay.
PulseShape pulse_shape(double rate_hz, double device_delay_s);

// The tables of a shape.
struct PulseTables {
  // The powers of time at each sample, made orthonormal.
  std::array<std::array<double, kPulsePowers>, kMaxSignSamples> powers{};
  // z, without the powers and of length 1.
  std::array<double, kMaxSignSamples> instrument{};
};

// Computes the tables. Not for a tick.
PulseTables pulse_tables(const PulseShape& shape);

// The sums over the samples of a pulse: scalar products of y, r, z and the powers.
struct PulseSums {
  std::array<double, kPulsePowers> y_powers{};
  std::array<double, kPulsePowers> r_powers{};
  double z_y = 0.0;
  double z_r = 0.0;
  double y_y = 0.0;
  double y_r = 0.0;
  double r_r = 0.0;
};

// The estimate from a whole pulse.
struct PulseAnswer {
  // g, in units of time; not finite if the pulse had no effort.
  double gain = 0.0;
  // True if the pulse explains enough of the motion to count.
  bool is_clear = false;
};

// Returns the estimate from the sums of a whole pulse.
PulseAnswer answer_of(const PulseSums& sums);

// The pulse under way on one joint. The members are public because the state saves them in the
// order of its format.
struct SignPulse {
  // Starts a pulse at the joint's position, rad or m. `effort` is the pulse's a with its sign, N m
  // or N.
  void begin(double position, double effort);

  // Adds a tick: the joint's position, and its effort since the last tick. Returns true if the
  // pulse ends with it; the sums are then whole.
  bool advance(double position, double effort, const PulseShape& shape, const PulseTables& tables);

  // Returns the pulse's effort in the present tick, N m or N; 0 without a pulse.
  [[nodiscard]] double push(const PulseShape& shape) const;

  bool is_running = false;
  // The number of ticks since the pulse began.
  std::uint32_t ticks = 0;
  // The position at the pulse's start, rad or m.
  double start = 0.0;
  // The sum of the efforts over this unit's ticks.
  double effort_sum = 0.0;
  // The mean efforts of the last units, by unit modulo the length.
  std::array<double, kMaxSignDelay + 1> efforts{};
  // The integral of the delayed effort, and its double integral r, in units of time.
  double effort_integral = 0.0;
  double effort_double_integral = 0.0;
  // The effort a of the pulse, with its sign.
  double amplitude = 0.0;
  PulseSums sums;

 private:
  void take_sample(double displacement, double mean_effort, const PulseShape& shape,
                   const PulseTables& tables);
};

}  // namespace tactus::firmware
