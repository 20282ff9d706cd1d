// A number with its derivatives along x, y and z: Dual<double, 3> as two pairs, so that processors
// with vector instructions work on two numbers at once. Each has the bits that dual.h's rules give.
#pragma once

#include "rendering/geometry/pair.h"
#include "rendering/surface/dual.h"

namespace tactus::rendering {

template <>
struct Dual<double, 3> {
  Pair value_and_x{};
  Pair yz{};
};
using GradientDual = Dual<double, 3>;

inline double value_of(const GradientDual& a) {
  return a.value_and_x[0];
}

// Puts the value in its place, beside the derivative along x that is there.
inline GradientDual with_value(double value, Pair value_and_x, Pair yz) {
  value_and_x[0] = value;
  return {.value_and_x = value_and_x, .yz = yz};
}

inline GradientDual chain(const GradientDual& a, double value, double slope) {
  return with_value(value, a.value_and_x * both(slope), a.yz * both(slope));
}

inline GradientDual chain(const GradientDual& a, const GradientDual& b, double value,
                          double along_a, double along_b) {
  return with_value(value, a.value_and_x * both(along_a) + b.value_and_x * both(along_b),
                    a.yz * both(along_a) + b.yz * both(along_b));
}

inline GradientDual operator+(const GradientDual& a, const GradientDual& b) {
  return {.value_and_x = a.value_and_x + b.value_and_x, .yz = a.yz + b.yz};
}

inline GradientDual operator-(const GradientDual& a, const GradientDual& b) {
  return {.value_and_x = a.value_and_x - b.value_and_x, .yz = a.yz - b.yz};
}

inline GradientDual operator*(const GradientDual& a, const GradientDual& b) {
  const double x = value_of(a);
  const double y = value_of(b);
  return chain(a, b, x * y, y, x);
}

inline GradientDual operator/(const GradientDual& a, const GradientDual& b) {
  const double value = value_of(a) / value_of(b);
  const Pair divisor = both(value_of(b));
  return with_value(value, (a.value_and_x - b.value_and_x * both(value)) / divisor,
                    (a.yz - b.yz * both(value)) / divisor);
}

inline GradientDual operator-(const GradientDual& a) {
  return {.value_and_x = -a.value_and_x, .yz = -a.yz};
}

inline GradientDual operator+(const GradientDual& a, double c) {
  return with_value(value_of(a) + c, a.value_and_x, a.yz);
}

inline GradientDual operator*(const GradientDual& a, double c) {
  return {.value_and_x = a.value_and_x * both(c), .yz = a.yz * both(c)};
}

inline GradientDual smaller(const GradientDual& a, const GradientDual& b) {
  return order(value_of(a), value_of(b)) == Order::first ? a : b;
}

}  // namespace tactus::rendering
