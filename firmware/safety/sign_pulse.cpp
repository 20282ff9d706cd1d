#include "firmware/safety/sign_pulse.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tactus::firmware {
namespace {

// The length of a unit, and T.
constexpr double kUnit_s = 0.001;
constexpr double kQuarter_s = 0.006;
// The number of times T in a pulse: three times four.
constexpr std::size_t kQuarters = 12;
// The share of the motion that the pulse must explain.
constexpr double kExplained = 0.5;
// The share of r that must lie along z: else the joint's other efforts outweigh the pulse.
constexpr double kInstrumentShare = 0.3;
// The number of powers of a cubic.
constexpr std::size_t kCubic = 4;

// Returns the scalar product of the first `count` entries.
double dot(const std::array<double, kPulsePowers>& a, const std::array<double, kPulsePowers>& b,
           std::size_t count) {
  return std::inner_product(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin(),
                            0.0);
}

// Fills the tables with the plain powers of time, from -1 to 1, and the plain z.
void fill(const PulseShape& shape, PulseTables& tables) {
  double integral = 0.0;
  double double_integral = 0.0;
  for (std::size_t n = 0; n < shape.samples; ++n) {
    const double t = 2.0 * static_cast<double>(n) / static_cast<double>(shape.samples - 1) - 1.0;
    tables.powers[n][0] = 1.0;
    for (std::size_t power = 1; power < kPulsePowers; ++power) {
      tables.powers[n][power] = t * tables.powers[n][power - 1];
    }
    if (n > shape.delay) {
      const double effort = shape.sign_in(n - 1 - shape.delay);
      double_integral += integral + 0.5 * effort;
      integral += effort;
    }
    tables.instrument[n] = double_integral;
  }
}

}  // namespace

double PulseShape::sign_in(std::size_t unit) const {
  if (unit >= kQuarters * quarter) {
    return 0.0;
  }
  const std::size_t place = unit / quarter % 4;
  return place == 0 || place == 3 ? 1.0 : -1.0;
}

PulseShape pulse_shape(double rate_hz, double device_delay_s) {
  PulseShape shape;
  shape.ticks_a_unit =
      static_cast<std::uint32_t>(std::max(1.0, std::floor(kUnit_s * rate_hz + 0.5)));
  shape.unit_s = shape.ticks_a_unit / rate_hz;
  shape.quarter = static_cast<std::size_t>(std::max(1.0, std::round(kQuarter_s / shape.unit_s)));
  // The integral already contains half a tick of the delay: the hold of an effort up to its middle.
  const double delay_s = std::max(0.0, device_delay_s - 0.5 / rate_hz);
  shape.delay =
      std::min(kMaxSignDelay, static_cast<std::size_t>(std::round(delay_s / shape.unit_s)));
  shape.samples = std::min(kMaxSignSamples, kQuarters * shape.quarter + shape.delay + 1);
  return shape;
}

// Computes the orthonormal powers by two passes of Gram-Schmidt, which is exact enough here.
PulseTables pulse_tables(const PulseShape& shape) {
  PulseTables tables;
  fill(shape, tables);
  const auto remove = [&](const auto& column, std::size_t power) {
    double along = 0.0;
    for (std::size_t n = 0; n < shape.samples; ++n) {
      along += column(n) * tables.powers[n][power];
    }
    for (std::size_t n = 0; n < shape.samples; ++n) {
      column(n) -= along * tables.powers[n][power];
    }
  };
  const auto normalize = [&](const auto& column) {
    double squares = 0.0;
    for (std::size_t n = 0; n < shape.samples; ++n) {
      squares += column(n) * column(n);
    }
    for (std::size_t n = 0; n < shape.samples; ++n) {
      column(n) /= std::sqrt(squares);
    }
  };
  for (std::size_t power = 0; power < kPulsePowers; ++power) {
    const auto column = [&](std::size_t n) -> double& { return tables.powers[n][power]; };
    for (std::size_t other = 0; other < 2 * power; ++other) {
      remove(column, other % power);
    }
    normalize(column);
  }
  const auto instrument = [&](std::size_t n) -> double& { return tables.instrument[n]; };
  for (std::size_t other = 0; other < 2 * kPulsePowers; ++other) {
    remove(instrument, other % kPulsePowers);
  }
  normalize(instrument);
  return tables;
}

PulseAnswer answer_of(const PulseSums& sums) {
  // The products of y and r after a cubic is subtracted from each: the powers are orthonormal, so
  // the cubic's part is the sum of the products of the first four coefficients.
  const double y_y = sums.y_y - dot(sums.y_powers, sums.y_powers, kCubic);
  const double y_r = sums.y_r - dot(sums.y_powers, sums.r_powers, kCubic);
  const double r_r = sums.r_r - dot(sums.r_powers, sums.r_powers, kCubic);
  const double gain = sums.z_y / sums.z_r;
  // The squared size of y - g r, both without their cubics.
  const double left = y_y - 2.0 * gain * y_r + gain * gain * r_r;
  return {.gain = gain,
          .is_clear = y_y > 0.0 && left < (1.0 - kExplained) * y_y &&
                      sums.z_r * sums.z_r > kInstrumentShare * kInstrumentShare * r_r};
}

void SignPulse::begin(double position, double effort) {
  *this = SignPulse{};
  is_running = true;
  start = position;
  amplitude = effort;
}

bool SignPulse::advance(double position, double effort, const PulseShape& shape,
                        const PulseTables& tables) {
  effort_sum += effort;
  ++ticks;
  if (ticks % shape.ticks_a_unit != 0) {
    return false;
  }
  take_sample(position - start, effort_sum / shape.ticks_a_unit, shape, tables);
  effort_sum = 0.0;
  if (ticks / shape.ticks_a_unit + 1 < shape.samples) {
    return false;
  }
  is_running = false;
  ticks = 0;
  return true;
}

double SignPulse::push(const PulseShape& shape) const {
  return is_running ? amplitude * shape.sign_in(ticks / shape.ticks_a_unit) : 0.0;
}

// Adds a sample to the sums: the joint's displacement since the pulse's start, and the unit's mean
// effort. The first sample of a pulse is 0 and adds nothing.
void SignPulse::take_sample(double displacement, double mean_effort, const PulseShape& shape,
                            const PulseTables& tables) {
  const std::size_t n = ticks / shape.ticks_a_unit;
  efforts[n % efforts.size()] = mean_effort;
  if (n > shape.delay) {
    const double effort = efforts[(n - shape.delay) % efforts.size()];
    effort_double_integral += effort_integral + 0.5 * effort;
    effort_integral += effort;
  }
  const double y = displacement;
  const double r = effort_double_integral;
  for (std::size_t power = 0; power < kPulsePowers; ++power) {
    sums.y_powers[power] += tables.powers[n][power] * y;
    sums.r_powers[power] += tables.powers[n][power] * r;
  }
  sums.z_y += tables.instrument[n] * y;
  sums.z_r += tables.instrument[n] * r;
  sums.y_y += y * y;
  sums.y_r += y * r;
  sums.r_r += r * r;
}

}  // namespace tactus::firmware
