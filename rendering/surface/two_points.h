// The functions of elementary.h and the derivatives of dual.h at two points at once. Each number
// has the bits that it has alone.
#pragma once

#include "rendering/geometry/pair.h"
#include "rendering/surface/elementary.h"

namespace tactus::rendering {

// Returns a function of a number at both places.
template <class Function>
Pair at_both(Pair a, const Function& function) {
  return Pair{function(a[0]), function(a[1])};
}
template <class Function>
Pair at_both(Pair a, Pair b, const Function& function) {
  return Pair{function(a[0], b[0]), function(a[1], b[1])};
}

inline Pair magnitude_slope(Pair a) {
  return a < 0.0 ? both(-1.0) : both(1.0);
}

inline Pair square_root(Pair a) {
  return at_both(a, [](double x) { return square_root(x); });
}

inline Pair square_root_slope(Pair root) {
  return at_both(root, [](double x) { return square_root_slope(x); });
}

inline Pair power(Pair a, int n) {
  return power_by_squares(a, both(1.0), n);
}

inline SineAndCosine<Pair> sine_and_cosine(Pair a) {
  const SineCosine first = sine_cosine(a[0]);
  const SineCosine second = sine_cosine(a[1]);
  return {Pair{first.sine, second.sine}, Pair{first.cosine, second.cosine}};
}

inline Pair exponential(Pair a) {
  return at_both(a, [](double x) { return exponential(x); });
}

inline Pair exponential_slope(Pair a, Pair value) {
  return at_both(a, value, [](double x, double y) { return exponential_slope(x, y); });
}

inline Pair logarithm(Pair a) {
  return at_both(a, [](double x) { return logarithm(x); });
}

inline Pair logarithm_slope(Pair a) {
  return at_both(a, [](double x) { return logarithm_slope(x); });
}

inline Pair real_power(Pair a, double c) {
  return at_both(a, [c](double x) { return real_power(x, c); });
}

inline Pair real_power_slope(Pair a, double c) {
  return at_both(a, [c](double x) { return real_power_slope(x, c); });
}

inline Pair power_norm(Pair a, Pair b, double p) {
  return at_both(a, b, [p](double x, double y) { return power_norm(x, y, p); });
}

inline Pair power_norm_slope(Pair a, Pair b, double p) {
  return at_both(a, b, [p](double x, double y) { return power_norm_slope(x, y, p); });
}

}  // namespace tactus::rendering
