// The functions of a formula and their derivatives, for numbers and for intervals. Each is defined
// everywhere: beyond its mathematical domain a function keeps the value at the domain's border and
// has the slope 0 there. The interval versions hold every value of the number versions.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/geometry/portable_math.h"
#include "rendering/surface/interval.h"

namespace tactus::rendering {

// The interval grows by this many roundings, more than the functions' own errors.
inline constexpr double kFunctionUlps = 16.0;

// Which of two is the smaller; an exact tie goes to the first.
enum class Order { first, second, unsure };

inline Order order(double a, double b) {
  return a <= b ? Order::first : Order::second;
}

inline Order order(const Interval& a, const Interval& b) {
  if (a.upper() < b.lower()) {
    return Order::first;
  }
  return b.upper() < a.lower() ? Order::second : Order::unsure;
}

inline double hull(double a, double /*b*/) {
  return a;
}

inline double smaller(double a, double b) {
  return a <= b ? a : b;
}

inline Interval smaller(const Interval& a, const Interval& b) {
  return Interval(Pair{std::max(a.ends()[0], b.ends()[0]), std::min(a.ends()[1], b.ends()[1])});
}

// |a| and its slope.
inline double magnitude(double a) {
  return std::abs(a);
}

inline double magnitude_slope(double a) {
  return a < 0.0 ? -1.0 : 1.0;
}

inline Interval magnitude(const Interval& a) {
  if (a.lower() >= 0.0) {
    return a;
  }
  return a.upper() <= 0.0 ? -a : Interval{0.0, std::max(-a.lower(), a.upper())};
}

inline Interval magnitude_slope(const Interval& a) {
  return {a.lower() < 0.0 ? -1.0 : 1.0, a.upper() >= 0.0 ? 1.0 : -1.0};
}

// The square root, 0 below 0. Its slope is taken from its value `root`; 0 where that is infinite.
inline double square_root(double a) {
  return a > 0.0 ? std::sqrt(a) : a <= 0.0 ? 0.0 : a;
}

inline double square_root_slope(double root) {
  return root > 0.0 ? 0.5 / root : 0.0;
}

inline Interval square_root(const Interval& a) {
  const Interval root = outwards(square_root(a.lower()), square_root(a.upper()));
  return {std::max(root.lower(), 0.0), root.upper()};
}

inline Interval square_root_slope(const Interval& root) {
  return root.lower() > 0.0 ? outwards(0.5 / root.upper(), 0.5 / root.lower())
                            : Interval{0.0, std::numeric_limits<double>::infinity()};
}

// a^n for n >= 1, of a number or of both of a pair.
template <class Number>
Number power_by_squares(Number a, Number one, int n) {
  Number result = (n & 1) != 0 ? a : one;
  for (n >>= 1; n != 0; n >>= 1) {
    a *= a;
    if ((n & 1) != 0) {
      result *= a;
    }
  }
  return result;
}

inline double power(double a, int n) {
  return power_by_squares(a, 1.0, n);
}

// An odd power keeps the sign with which `ends()` gives an end, an even one takes it away.
inline Interval power(const Interval& a, int n) {
  const double ulps = 2.0 * n;
  if (n == 1) {
    return a;
  }
  const Pair ends = power_by_squares(a.ends(), both(1.0), n);
  if (n % 2 != 0) {
    return rounded(ends, ulps);
  }
  if (a.lower() >= 0.0) {
    return rounded(ends[0], ends[1], ulps);
  }
  return a.upper() <= 0.0 ? rounded(ends[1], ends[0], ulps)
                          : rounded(0.0, std::max(ends[0], ends[1]), ulps);
}

inline double sine(double a) {
  return sine_cosine(a).sine;
}

inline double cosine(double a) {
  return sine_cosine(a).cosine;
}

// Returns the interval of sin(a + quarter_turns * pi/2).
inline Interval shifted_sine(const Interval& a, double at_lower, double at_upper, int shift) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  const bool has_sine = a.lower() >= -kLargestAngle && a.upper() <= kLargestAngle;
  if (!has_sine) {
    return kEverything;
  }
  const double first = std::floor(a.lower() * kTwoOverPi);
  const double last = std::floor(a.upper() * kTwoOverPi);
  if (last - first >= 4.0) {
    return {-1.0, 1.0};
  }
  constexpr double kAbsolute = 1e-15;
  const Interval range =
      outwards(std::min(at_lower, at_upper), std::max(at_lower, at_upper), kFunctionUlps);
  Pair ends = range.ends() + both(kAbsolute);
  // A turning point lies at each odd number of quarter turns.
  for (int k = static_cast<int>(first) + 1; k <= static_cast<int>(last); ++k) {
    const unsigned quarter = static_cast<unsigned>(k + shift) % 4U;
    ends[1] = quarter == 1U ? 1.0 : ends[1];
    ends[0] = quarter == 3U ? 1.0 : ends[0];
  }
  return Interval(smaller(ends, both(1.0)));
}

// The sine and the cosine of one number, which its value and its slope need together.
template <class Number>
struct SineAndCosine {
  Number sine;
  Number cosine;
};

inline SineAndCosine<double> sine_and_cosine(double a) {
  const SineCosine at = sine_cosine(a);
  return {at.sine, at.cosine};
}

// Returns true if an interval holds nothing but angles, and its ends are so near to each other that
// sine and cosine are enclosed from the values at its middle.
inline bool is_narrow_angle(const Interval& a) {
  constexpr double kNarrow_rad = 0x1p-5;
  return a.upper() - a.lower() <= kNarrow_rad &&
         std::max(a.ends()[0], a.ends()[1]) <= kLargestAngle;
}

// Returns the intervals from the values at the middle m: by Taylor's theorem sin(x) differs from
// sin(m) by at most |cos(m)| |x - m| + (x - m)^2 / 2, and cos(x) from cos(m) likewise.
inline SineAndCosine<Interval> sine_and_cosine_near(const Interval& a) {
  // Covers the errors of the values at m and at x, and the roundings here, which are below 2^-52
  // times a number below 1 each.
  constexpr double kAbsolute = 1.5e-15;
  constexpr double kAboveRoundings = 1.0 + 0x1p-50;
  const double middle = a.lower() + 0.5 * (a.upper() - a.lower());
  const double half = std::max(middle - a.lower(), a.upper() - middle) * kAboveRoundings;
  const SineCosine at = sine_cosine(middle);
  const double bend = 0.5 * half * half + kAbsolute;
  const Pair sine = both(std::abs(at.cosine) * half + bend) + Pair{-at.sine, at.sine};
  const Pair cosine = both(std::abs(at.sine) * half + bend) + Pair{-at.cosine, at.cosine};
  return {Interval(smaller(sine, both(1.0))), Interval(smaller(cosine, both(1.0)))};
}

inline SineAndCosine<Interval> sine_and_cosine(const Interval& a) {
  if (is_narrow_angle(a)) {
    return sine_and_cosine_near(a);
  }
  const SineCosine lower = sine_cosine(a.lower());
  const SineCosine upper = sine_cosine(a.upper());
  return {shifted_sine(a, lower.sine, upper.sine, 0),
          shifted_sine(a, lower.cosine, upper.cosine, 1)};
}

inline Interval sine(const Interval& a) {
  return sine_and_cosine(a).sine;
}

inline Interval cosine(const Interval& a) {
  return sine_and_cosine(a).cosine;
}

inline Interval exponential(const Interval& a) {
  return outwards(exponential(a.lower()), exponential(a.upper()), kFunctionUlps);
}

// Returns the slope of exp(a) from the argument and the value.
inline double exponential_slope(double a, double value) {
  return std::abs(a) <= kLargestExponent ? value : 0.0;
}

inline Interval exponential_slope(const Interval& a, const Interval& value) {
  return a.lower() >= -kLargestExponent && a.upper() <= kLargestExponent ? value
                                                                         : hull(value, {0.0, 0.0});
}

inline Interval logarithm(const Interval& a) {
  return outwards(logarithm(a.lower()), logarithm(a.upper()), kFunctionUlps);
}

inline double logarithm_slope(double a) {
  return a > kSmallestLogarithmArgument ? 1.0 / a : 0.0;
}

inline Interval logarithm_slope(const Interval& a) {
  return a.lower() > kSmallestLogarithmArgument
             ? outwards(1.0 / a.upper(), 1.0 / a.lower())
             : Interval{0.0, std::numeric_limits<double>::infinity()};
}

// a^c for a real c; below 0 as at the smallest positive number.
inline double real_power(double a, double c) {
  return exponential(c * logarithm(a));
}

inline double real_power_slope(double a, double c) {
  return a > kSmallestLogarithmArgument ? c * exponential((c - 1.0) * logarithm(a)) : 0.0;
}

inline Interval real_power(const Interval& a, double c) {
  return exponential(logarithm(a) * c);
}

inline Interval real_power_slope(const Interval& a, double c) {
  const Interval slope = exponential(logarithm(a) * (c - 1.0)) * c;
  return a.lower() > kSmallestLogarithmArgument ? slope : hull(slope, {0.0, 0.0});
}

// Ricci's blend (a^p + b^p)^(1/p) of two numbers above 0, |p| >= 1. Written with the ratio of the
// two, so that no power overflows. Grows with a and with b.
inline double power_norm(double a, double b, double p) {
  a = std::max(a, kSmallestLogarithmArgument);
  b = std::max(b, kSmallestLogarithmArgument);
  const double small = std::min(a, b);
  const double large = std::max(a, b);
  const double ratio = exponential(std::abs(p) * logarithm(small / large));
  return (p > 0.0 ? large : small) * exponential(logarithm(1.0 + ratio) / p);
}

// Its slope along a: (a / norm)^(p - 1), between 0 and 1.
inline double power_norm_slope(double a, double b, double p) {
  if (!(a > kSmallestLogarithmArgument)) {
    return 0.0;
  }
  return exponential((p - 1.0) * logarithm(a / power_norm(a, b, p)));
}

inline Interval power_norm(const Interval& a, const Interval& b, double p) {
  return outwards(power_norm(a.lower(), b.lower(), p), power_norm(a.upper(), b.upper(), p), 2048.0);
}

inline Interval power_norm_slope(const Interval& a, const Interval& b, double p) {
  // Monotone in each: the larger argument counts more for p > 0, the smaller for p < 0.
  const double one =
      power_norm_slope(std::max(a.lower(), 2.0 * kSmallestLogarithmArgument), b.upper(), p);
  const double other =
      power_norm_slope(std::max(a.upper(), 2.0 * kSmallestLogarithmArgument), b.lower(), p);
  const double lower = a.lower() > kSmallestLogarithmArgument ? std::min(one, other) : 0.0;
  constexpr double kAbsolute = 1e-12;
  return {lower - kAbsolute, std::max(one, other) * (1.0 + kAbsolute) + kAbsolute};
}

}  // namespace tactus::rendering
