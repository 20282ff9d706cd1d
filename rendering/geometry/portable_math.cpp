// Each function reduces its argument to a short interval, exactly or in two parts, and sums a
// series there. There are only additions, multiplications and divisions, in a fixed order, so that
// IEEE 754 determines every bit (with -ffp-contract=off).
#include "rendering/geometry/portable_math.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rendering/geometry/pair.h"

namespace tactus::rendering {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kMantissaBits = 52;
constexpr int kBias = 1023;

// ln 2 and pi/2 in two parts (Cody and Waite): the first has 33 significant bits, so that its
// product with an integer below 2^20 is exact.
constexpr double kLn2High = 0x1.62e42fee00000p-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kHalfPiHigh = 0x1.921fb54400000p+0;
constexpr double kHalfPiLow = 0x1.0b4611a626331p-34;

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

// Taylor's remainders: (pi/4)^18/18! = 2e-18 and (ln(2)/2)^14/14! = 4e-18.
constexpr auto kReciprocalFactorial = reciprocal_factorials<18>();
constexpr std::size_t kExponentialTerms = 14;

// 1/(1 + 2k)! and 1/(2k)! for k = 0..8, those of the sine and the cosine.
constexpr std::size_t kAlternatingTerms = 9;
constexpr std::array<Pair, kAlternatingTerms> alternating_coefficients() {
  std::array<Pair, kAlternatingTerms> table{};
  for (std::size_t k = 0; k < kAlternatingTerms; ++k) {
    table[k] = Pair{kReciprocalFactorial[2 * k + 1], kReciprocalFactorial[2 * k]};
  }
  return table;
}
constexpr auto kAlternatingCoefficients = alternating_coefficients();

// sum over k of (-r^2)^k / (first + 2k)!, for both functions at once: the sine, but for a factor r,
// with first = 1, and the cosine with first = 0.
Pair alternating_series(double r_squared) {
  const Pair x = both(-r_squared);
  Pair sum = kAlternatingCoefficients.back();
  for (std::size_t k = kAlternatingTerms - 1; k-- > 0;) {
    sum = x * sum + kAlternatingCoefficients[k];
  }
  return sum;
}

// Returns 2^exponent, by its bits; the exponent must be that of a normal number.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kBias) << kMantissaBits);
}

}  // namespace

SineCosine sine_cosine(double x) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  const bool is_angle = x >= -kLargestAngle && x <= kLargestAngle;
  if (!is_angle) {
    return {kNaN, kNaN};
  }
  // x = quadrant * pi / 2 + r with |r| <= pi / 4. The quadrant is below 2^20, so its product with
  // the high part is exact.
  const int quadrant = static_cast<int>(x * kTwoOverPi + (x < 0.0 ? -0.5 : 0.5));
  const double r = (x - quadrant * kHalfPiHigh) - quadrant * kHalfPiLow;
  const Pair series = alternating_series(r * r);
  const double sine = r * series[0];
  const double cosine = series[1];
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

double exponential(double x) {
  constexpr double kLog2OfE = 0x1.71547652b82fep+0;
  const bool is_inside = x >= -kLargestExponent && x <= kLargestExponent;
  if (!is_inside) {
    if (x > 0.0) {
      return exponential(kLargestExponent);
    }
    return x < 0.0 ? exponential(-kLargestExponent) : kNaN;
  }
  // x = exponent * ln 2 + r with |r| <= ln(2) / 2, so e^x = 2^exponent e^r.
  const int exponent = static_cast<int>(x * kLog2OfE + (x < 0.0 ? -0.5 : 0.5));
  const double r = (x - exponent * kLn2High) - exponent * kLn2Low;
  // Even and odd powers are two chains that do not wait for each other.
  const double r_squared = r * r;
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t n = kExponentialTerms; n > 0; n -= 2) {
    even = kReciprocalFactorial[n - 2] + r_squared * even;
    odd = kReciprocalFactorial[n - 1] + r_squared * odd;
  }
  return (even + r * odd) * power_of_two(exponent);
}

double logarithm(double x) {
  constexpr double kSqrtHalf = 0x1.6a09e667f3bcdp-1;
  constexpr std::uint64_t kMantissaMask = (std::uint64_t{1} << kMantissaBits) - 1;
  if (!(x <= std::numeric_limits<double>::max())) {
    return x;
  }
  const auto bits = std::bit_cast<std::uint64_t>(std::max(x, kSmallestLogarithmArgument));
  // x = m 2^exponent with m between sqrt(1/2) and sqrt(2).
  int exponent = static_cast<int>(bits >> kMantissaBits) - kBias + 1;
  auto m = std::bit_cast<double>((bits & kMantissaMask) |
                                 (static_cast<std::uint64_t>(kBias - 1) << kMantissaBits));
  if (m < kSqrtHalf) {
    m *= 2.0;
    --exponent;
  }
  // log m = 2 atanh((m - 1) / (m + 1)); the first term left out is s^23/23 < 2e-19.
  const double s = (m - 1.0) / (m + 1.0);
  const double s_squared = s * s;
  double sum = 0.0;
  for (int k = 10; k >= 1; --k) {
    sum = s_squared * (1.0 / (2.0 * k + 1.0) + sum);
  }
  return exponent * kLn2High + (2.0 * s + (2.0 * s * sum + exponent * kLn2Low));
}

// A third of the bits is the root within 4 percent, since the exponent is among them; the constant
// puts the bias of the exponent back. Halley's iteration triples the digits each time.
double cube_root(double x) {
  constexpr std::uint64_t kTwoThirdsOfBias = 0x2A9F'7893'0000'0000;
  constexpr int kIterations = 4;
  const bool is_in_range = x >= kSmallestCube && x <= kLargestCube;
  if (!is_in_range) {
    return 0.0;
  }
  auto root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + kTwoThirdsOfBias);
  for (int i = 0; i < kIterations; ++i) {
    const double cube = root * root * root;
    root -= root * ((cube - x) / (2.0 * cube + x));
  }
  return root;
}

}  // namespace tactus::rendering
