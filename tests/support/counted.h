// A number that counts the multiplications and divisions made with it.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace tactus::testing {

struct Counted {
  double value = 0.0;
  static inline std::size_t products = 0;  // multiplications and divisions, since a test set it

  Counted() = default;
  explicit Counted(double v) : value(v) {}

  Counted operator-() const { return Counted(-value); }
  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator/=(const Counted& b) { return *this = *this / b; }

  friend Counted operator+(const Counted& a, const Counted& b) {
    return Counted(a.value + b.value);
  }
  friend Counted operator-(const Counted& a, const Counted& b) {
    return Counted(a.value - b.value);
  }
  friend Counted operator*(const Counted& a, const Counted& b) {
    ++products;
    return Counted(a.value * b.value);
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    ++products;
    return Counted(a.value / b.value);
  }
  friend auto operator<=>(const Counted& a, const Counted& b) { return a.value <=> b.value; }
  friend bool operator==(const Counted& a, const Counted& b) = default;
};

}  // namespace tactus::testing

template <>
struct Eigen::NumTraits<tactus::testing::Counted> : Eigen::GenericNumTraits<double> {
  using Real = tactus::testing::Counted;
  using NonInteger = tactus::testing::Counted;
  using Nested = tactus::testing::Counted;
  using Literal = tactus::testing::Counted;
};
