#include "host_tools/simulation/portable_math.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

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

// Taylor's remainder: for exp on |r| <= ln(2)/2, r^14/14! = 4e-18; for sin and cos on |r| <= pi/4,
// r^18/18! = 2e-18.
constexpr auto kExpCoefficients = reciprocal_factorials<14>();
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

double exp_nonpositive(double x) {
  if (!(x > -700.0)) {
    return 0.0;
  }
  constexpr double kLog2OfE = 0x1.71547652b82fep+0;
  constexpr double kLn2High =
      0x1.62e42fee00000p-1;  // 33 bits: times an integer below 2^20 it is exact
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const int exponent = static_cast<int>(x * kLog2OfE - 0.5);
  const auto n = static_cast<double>(exponent);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  double sum = kExpCoefficients.back();
  for (std::size_t k = kExpCoefficients.size() - 1; k-- > 0;) {
    sum = kExpCoefficients[k] + r * sum;
  }
  constexpr std::uint64_t kMantissaBits = 52;
  constexpr int kBias = 1023;
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kBias) << kMantissaBits);
}

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
