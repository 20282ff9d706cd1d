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
  return outwards(a.lower + b.lower, a.upper + b.upper);
}

inline Interval operator-(const Interval& a, const Interval& b) {
  return outwards(a.lower - b.upper, a.upper - b.lower);
}

inline Interval operator+(const Interval& a, double c) {
  return outwards(a.lower + c, a.upper + c);
}

inline Interval operator*(const Interval& a, double c) {
  return c < 0.0 ? outwards(a.upper * c, a.lower * c) : outwards(a.lower * c, a.upper * c);
}

inline Interval operator*(const Interval& a, const Interval& b) {
  const std::array<double, 4> p{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower,
                                a.upper * b.upper};
  if (std::isnan(p[0] + p[1] + p[2] + p[3])) {
    return kEverything;  // zero times infinity
  }
  return outwards(std::min({p[0], p[1], p[2], p[3]}), std::max({p[0], p[1], p[2], p[3]}));
}

inline Interval operator/(const Interval& a, const Interval& b) {
  return contains(b, 0.0) ? kEverything : a * outwards(1.0 / b.upper, 1.0 / b.lower);
}

}  // namespace tactus::rendering
