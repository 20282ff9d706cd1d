#include "rendering/effects/phase.h"

#include <cmath>

namespace tactus::rendering {
namespace {

constexpr int kQuarterBits = 62;
constexpr Phase kQuarter = Phase{1} << kQuarterBits;

constexpr double factorial(int n) {
  return n < 2 ? 1.0 : static_cast<double>(n) * factorial(n - 1);
}

// Taylor's sum for 0 <= r <= pi/2; the first term left out is 2.6e-16.
double sine_of_quarter(double r) {
  const double x = r * r;
  double sum = -1.0 / factorial(19);
  sum = sum * x + 1.0 / factorial(17);
  sum = sum * x - 1.0 / factorial(15);
  sum = sum * x + 1.0 / factorial(13);
  sum = sum * x - 1.0 / factorial(11);
  sum = sum * x + 1.0 / factorial(9);
  sum = sum * x - 1.0 / factorial(7);
  sum = sum * x + 1.0 / factorial(5);
  sum = sum * x - 1.0 / factorial(3);
  return r + r * x * sum;
}

}  // namespace

Phase phase_of_turns(double turns) {
  constexpr double kWholeTurn = 0x1p64;
  const double part = turns - std::floor(turns);  // 1 where a tiny negative number is rounded
  return part < 1.0 ? static_cast<Phase>(part * kWholeTurn) : 0;
}

double sine(Phase phase) {
  constexpr double kRadiansPerUnit = 0x1.921fb54442d18p-62;  // pi/2 over 2^62
  const auto quarter = phase >> kQuarterBits;
  const Phase within = phase & (kQuarter - 1);
  const bool falling = (quarter & 1U) != 0;
  const double r = static_cast<double>(falling ? kQuarter - within : within) * kRadiansPerUnit;
  const double magnitude = sine_of_quarter(r);
  return quarter < 2 ? magnitude : -magnitude;
}

}  // namespace tactus::rendering
