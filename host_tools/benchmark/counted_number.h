// A number that counts the multiplications and divisions made with it: `tactus bench
// multiplications` and the tests of plane_solutions.h solve with it in the place of double.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace tactus::host {

struct CountedNumber {
  double value = 0.0;
  // The multiplications and divisions so far, of all numbers.
  static inline std::size_t products = 0;

  CountedNumber() = default;
  explicit CountedNumber(double v) : value(v) {}

  CountedNumber operator-() const { return CountedNumber(-value); }
  CountedNumber& operator+=(const CountedNumber& b) { return *this = *this + b; }
  CountedNumber& operator/=(const CountedNumber& b) { return *this = *this / b; }

  friend CountedNumber operator+(const CountedNumber& a, const CountedNumber& b) {
    return CountedNumber(a.value + b.value);
  }
  friend CountedNumber operator-(const CountedNumber& a, const CountedNumber& b) {
    return CountedNumber(a.value - b.value);
  }
  friend CountedNumber operator*(const CountedNumber& a, const CountedNumber& b) {
    ++products;
    return CountedNumber(a.value * b.value);
  }
  friend CountedNumber operator/(const CountedNumber& a, const CountedNumber& b) {
    ++products;
    return CountedNumber(a.value / b.value);
  }
  friend auto operator<=>(const CountedNumber& a, const CountedNumber& b) {
    return a.value <=> b.value;
  }
  friend bool operator==(const CountedNumber& a, const CountedNumber& b) = default;
};

}  // namespace tactus::host

template <>
struct Eigen::NumTraits<tactus::host::CountedNumber> : Eigen::GenericNumTraits<double> {
  using Real = tactus::host::CountedNumber;
  using NonInteger = tactus::host::CountedNumber;
  using Nested = tactus::host::CountedNumber;
  using Literal = tactus::host::CountedNumber;
};
