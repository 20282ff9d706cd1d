// Interval arithmetic, rounded outwards: each result holds every value that the operation on
// doubles can give for operands within the intervals.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/geometry/pair.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {

// All numbers from a lower end to an upper end. The lower end is never above the upper one; it may
// be -infinity, and the upper one infinity.
class Interval {
 public:
  constexpr Interval() = default;
  constexpr Interval(double lower, double upper) : ends_{-lower, upper} {}
  // Takes the ends as `ends()` gives them.
  explicit constexpr Interval(Pair ends) : ends_(ends) {}

  [[nodiscard]] constexpr double lower() const { return -ends_[0]; }
  [[nodiscard]] constexpr double upper() const { return ends_[1]; }
  // Returns the lower end with the other sign, and the upper end: outwards is up at both.
  [[nodiscard]] constexpr Pair ends() const { return ends_; }

 private:
  Pair ends_{};
};

inline constexpr Interval kEverything{-std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::infinity()};

// Widened by `ulps` roundings of each end; everything if an end is not a number.
inline Interval outwards(Pair ends, double ulps = 1.0) {
  constexpr double kUlp = 0x1p-52;
  constexpr double kSmallest = std::numeric_limits<double>::min();
  constexpr double kLargest = std::numeric_limits<double>::max();
  ends = larger(both(-kLargest), ends);
  const bool are_ordered = ends[0] + ends[1] >= 0.0;
  if (!are_ordered) {
    return kEverything;
  }
  return Interval(ends + (both(ulps * kUlp) * magnitude(ends) + both(kSmallest)));
}

inline Interval outwards(double lower, double upper, double ulps = 1.0) {
  return outwards(Pair{-lower, upper}, ulps);
}

// Widens the result of an operation that a double carries out with one rounding. Such an operation
// never rounds across 0, so an end that is not below 0, or not above 0, stays so: the square of a
// number is known to be no less than 0.
inline Interval rounded(Pair ends, double ulps = 1.0) {
  const Pair wide = outwards(ends, ulps).ends();
  return Interval(ends <= 0.0 ? smaller(wide, both(0.0)) : wide);
}

inline Interval rounded(double lower, double upper, double ulps = 1.0) {
  return rounded(Pair{-lower, upper}, ulps);
}

// The numbers of `rounded` with one rounding. They are in memory, from where the processor takes
// each with the operation that needs it; as constants they would be put together anew at each use.
struct OneRounding {
  Pair ulp;
  Pair smallest;
  // The bits of a double but for its sign.
  PairBits magnitude;
};
// Weak, since a compiler that sees the numbers makes them constants again.
[[gnu::weak]] extern const OneRounding kOneRounding;

// Returns what `rounded` returns with one rounding, for ends that are known to be ordered and above
// -infinity.
[[gnu::always_inline]] inline Interval rounded_once(Pair ends) {
  const Pair magnitude =
      std::bit_cast<Pair>(std::bit_cast<PairBits>(ends) & kOneRounding.magnitude);
  const Pair wide = ends + (kOneRounding.ulp * magnitude + kOneRounding.smallest);
  // The mask is 0 where an end is not above 0; elsewhere it is no number, and `smaller` passes it
  // over.
  return Interval(smaller(std::bit_cast<Pair>(ends > 0.0), wide));
}

// Returns what `rounded` returns for the ends of a sum.
[[gnu::always_inline]] inline Interval rounded_sum(Pair ends) {
  const bool are_ordered = ends[0] + ends[1] >= 0.0;
  if (!are_ordered) [[unlikely]] {
    return rounded(ends);
  }
  return rounded_once(ends);
}

inline Interval hull(const Interval& a, const Interval& b) {
  return Interval(larger(a.ends(), b.ends()));
}

inline bool contains(const Interval& a, double x) {
  return a.lower() <= x && x <= a.upper();
}

inline Interval operator-(const Interval& a) {
  return Interval(swapped(a.ends()));
}

inline Interval operator+(const Interval& a, const Interval& b) {
  return rounded_sum(a.ends() + b.ends());
}

inline Interval operator-(const Interval& a, const Interval& b) {
  return rounded_sum(a.ends() + swapped(b.ends()));
}

inline Interval operator+(const Interval& a, double c) {
  return rounded_sum(a.ends() + Pair{-c, c});
}

inline Interval operator*(const Interval& a, double c) {
  return rounded_sum(c < 0.0 ? swapped(a.ends()) * both(-c) : a.ends() * both(c));
}

// The largest of the four products of two ends is the upper end, and the smallest the lower one.
[[gnu::always_inline]] inline Interval operator*(const Interval& a, const Interval& b) {
  const Pair same = a.ends() * b.ends();               // lower * lower, upper * upper
  const Pair opposite = a.ends() * swapped(b.ends());  // -lower * upper, -upper * lower
  const Pair one{opposite[0], same[0]};
  const Pair other{opposite[1], same[1]};
  const Pair ends = larger(larger(one, other), -swapped(smaller(one, other)));
  const Pair sums = same - opposite;
  const double sum = sums[0] + sums[1];
  if (std::isnan(sum - sum)) [[unlikely]] {  // a product is infinite or zero times infinity
    const bool has_nan = std::isnan(same[0]) || std::isnan(same[1]) || std::isnan(opposite[0]) ||
                         std::isnan(opposite[1]);
    return has_nan ? kEverything : rounded(ends);
  }
  return rounded_once(ends);
}

// Returns 1 / b. Beside a pole it is a half-line, so that the sign of the quotient is known there.
inline Interval inverse(const Interval& b) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (b.lower() < 0.0 && b.upper() > 0.0) {
    return kEverything;
  }
  return rounded(b.upper() == 0.0 ? -kInfinity : 1.0 / b.upper(),
                 b.lower() == 0.0 ? kInfinity : 1.0 / b.lower());
}

inline Interval operator/(const Interval& a, const Interval& b) {
  return a * inverse(b);
}

}  // namespace tactus::rendering
