// Interval arithmetic, rounded outwards: each result holds every value that the operation on
// doubles can give for operands within the intervals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

inline constexpr Interval kEverything{-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

// Widened by `ulps` roundings of each end; everything if an end is not a number.
inline Interval outwards(double lower, double upper, double ulps = 1.0) {
  constexpr double kUlp = 0x1p-52;
  constexpr double kSmallest = std::numeric_limits<double>::min();
  if (!(lower <= upper)) {
    return kEverything;
  }
  constexpr double kLargest = std::numeric_limits<double>::max();
  lower = std::min(lower, kLargest);
  upper = std::max(upper, -kLargest);
  return {lower - (ulps * kUlp * std::abs(lower) + kSmallest),
          upper + (ulps * kUlp * std::abs(upper) + kSmallest)};
}

// Widens the result of an operation that a double carries out with one rounding. Such an operation
// never rounds across 0, so an end that is not below 0, or not above 0, stays so: the square of a
// number is known to be no less than 0.
inline Interval rounded(double lower, double upper, double ulps = 1.0) {
  const Interval wide = outwards(lower, upper, ulps);
  return {lower >= 0.0 ? std::max(wide.lower, 0.0) : wide.lower,
          upper <= 0.0 ? std::min(wide.upper, 0.0) : wide.upper};
}

inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

inline bool contains(const Interval& a, double x) {
  return a.lower <= x && x <= a.upper;
}

inline Interval operator-(const Interval& a) {
  return {-a.upper, -a.lower};
}

inline Interval operator+(const Interval& a, const Interval& b) {
  return rounded(a.lower + b.lower, a.upper + b.upper);
}

inline Interval operator-(const Interval& a, const Interval& b) {
  return rounded(a.lower - b.upper, a.upper - b.lower);
}

inline Interval operator+(const Interval& a, double c) {
  return rounded(a.lower + c, a.upper + c);
}

inline Interval operator*(const Interval& a, double c) {
  return c < 0.0 ? rounded(a.upper * c, a.lower * c) : rounded(a.lower * c, a.upper * c);
}

inline Interval operator*(const Interval& a, const Interval& b) {
  const std::array<double, 4> p{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower,
                                a.upper * b.upper};
  if (std::isnan(p[0] + p[1] + p[2] + p[3])) {
    return kEverything;  // zero times infinity
  }
  return rounded(std::min({p[0], p[1], p[2], p[3]}), std::max({p[0], p[1], p[2], p[3]}));
}

// Returns 1 / b. Beside a pole it is a half-line, so that the sign of the quotient is known there.
inline Interval inverse(const Interval& b) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (b.lower < 0.0 && b.upper > 0.0) {
    return kEverything;
  }
  return rounded(b.upper == 0.0 ? -kInfinity : 1.0 / b.upper,
                 b.lower == 0.0 ? kInfinity : 1.0 / b.lower);
}

inline Interval operator/(const Interval& a, const Interval& b) {
  return a * inverse(b);
}

}  // namespace tactus::rendering
