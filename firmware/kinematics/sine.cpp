#include "firmware/kinematics/sine.h"

#include <limits>

namespace tactus::firmware {
namespace {

constexpr double kLargestAngle_rad = 1000.0;

// pi/2 in two parts (Cody and Waite): the first has 33 significant bits, so that its product with a
// quadrant number below 2^20 is exact.
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

constexpr double factorial(int n) {
  return n < 2 ? 1.0 : static_cast<double>(n) * factorial(n - 1);
}

// Taylor sums for |r| <= pi/4; the first term left out is below 5e-18.
double sine_near_zero(double r) {
  const double x = r * r;
  double sum = 1.0 / factorial(17);
  sum = sum * x - 1.0 / factorial(15);
  sum = sum * x + 1.0 / factorial(13);
  sum = sum * x - 1.0 / factorial(11);
  sum = sum * x + 1.0 / factorial(9);
  sum = sum * x - 1.0 / factorial(7);
  sum = sum * x + 1.0 / factorial(5);
  sum = sum * x - 1.0 / factorial(3);
  return r + r * x * sum;
}

double cosine_near_zero(double r) {
  const double x = r * r;
  double sum = 1.0 / factorial(16);
  sum = sum * x - 1.0 / factorial(14);
  sum = sum * x + 1.0 / factorial(12);
  sum = sum * x - 1.0 / factorial(10);
  sum = sum * x + 1.0 / factorial(8);
  sum = sum * x - 1.0 / factorial(6);
  sum = sum * x + 1.0 / factorial(4);
  sum = sum * x - 1.0 / factorial(2);
  return 1.0 + x * sum;
}

}  // namespace

SineCosine sine_cosine(double angle_rad) {
  const bool inside = angle_rad >= -kLargestAngle_rad && angle_rad <= kLargestAngle_rad;
  if (!inside) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return {kNaN, kNaN};
  }
  const double turns = angle_rad * kTwoOverPi;
  const int quadrant = static_cast<int>(turns < 0.0 ? turns - 0.5 : turns + 0.5);
  const double r = (angle_rad - quadrant * kHalfPiHigh) - quadrant * kHalfPiLow;
  const double sine = sine_near_zero(r);
  const double cosine = cosine_near_zero(r);
  switch (static_cast<unsigned>(quadrant) % 4U) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace tactus::firmware
