#include "host_tools/simulation/portable_math.h"

#include <array>
#include <cstddef>

namespace tactus::host {
namespace {

// 1/n! for n = 0..N-1; every factorial up to 18! is exact in a double.
template <std::size_t N>
constexpr std::array<double, N> reciprocal_factorials() {
  std::array<double, N> table{};
  double factorial = 1.0;
  for (std::size_t n = 0; n < N; ++n) {
    factorial *= n == 0 ? 1.0 : static_cast<double>(n);
    table[n] = 1.0 / factorial;
  }
  return table;
}

// Taylor's remainder on |r| <= pi/4: r^18/18! = 2e-18.
constexpr auto kTrigCoefficients = reciprocal_factorials<18>();

// sum over k of (-r^2)^k / (first + 2k)!: cos from 0; sin, but for a factor r, from 1.
double alternating_series(double r_squared, std::size_t first) {
  double sum = 0.0;
  for (std::size_t k = 9; k-- > 0;) {
    sum = kTrigCoefficients[first + 2 * k] - r_squared * sum;
  }
  return sum;
}

}  // namespace

SinCos sin_cos(double x) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kHalfPiHigh = 0x1.921fb54400000p+0;  // 33 bits
  constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;
  const int quadrant = static_cast<int>(x * kTwoOverPi + (x < 0.0 ? -0.5 : 0.5));
  const auto n = static_cast<double>(quadrant);
  const double r = (x - n * kHalfPiHigh) - n * kHalfPiLow;
  const double sine = r * alternating_series(r * r, 1);
  const double cosine = alternating_series(r * r, 0);
  switch (static_cast<unsigned>(quadrant) & 3U) {
    case 0:
      return {.sin = sine, .cos = cosine};
    case 1:
      return {.sin = cosine, .cos = -sine};
    case 2:
      return {.sin = -sine, .cos = -cosine};
    default:
      return {.sin = -cosine, .cos = sine};
  }
}

}  // namespace tactus::host
