// Forward automatic differentiation: a value and its derivatives along N directions, carried
// through every operation by the chain rule. Exact but for rounding. The scalar is a number, an
// interval, whose value and derivatives hold those of every point, or a pair, for two points at
// once.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/geometry/pair.h"
#include "rendering/surface/elementary.h"
#include "rendering/surface/two_points.h"

namespace tactus::rendering {

template <class Scalar, std::size_t N>
struct Dual {
  Scalar v{};
  std::array<Scalar, N> d{};
};

// Returns the value alone.
template <class S, std::size_t N>
const S& value_of(const Dual<S, N>& a) {
  return a.v;
}

// f(a) from its value and slope there.
template <class S, std::size_t N>
Dual<S, N> chain(const Dual<S, N>& a, const S& value, const S& slope) {
  Dual<S, N> r{.v = value};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] * slope;
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator+(const Dual<S, N>& a, const Dual<S, N>& b) {
  Dual<S, N> r{.v = a.v + b.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] + b.d[i];
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator-(const Dual<S, N>& a, const Dual<S, N>& b) {
  Dual<S, N> r{.v = a.v - b.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] - b.d[i];
  }
  return r;
}

// f(a, b) from its value and its slopes along a and b there.
template <class S, std::size_t N>
Dual<S, N> chain(const Dual<S, N>& a, const Dual<S, N>& b, const S& value, const S& along_a,
                 const S& along_b) {
  Dual<S, N> r{.v = value};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] * along_a + b.d[i] * along_b;
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator*(const Dual<S, N>& a, const Dual<S, N>& b) {
  Dual<S, N> r{.v = a.v * b.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] * b.v + b.d[i] * a.v;
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator/(const Dual<S, N>& a, const Dual<S, N>& b) {
  Dual<S, N> r{.v = a.v / b.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = (a.d[i] - b.d[i] * r.v) / b.v;
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator-(const Dual<S, N>& a) {
  Dual<S, N> r{.v = -a.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = -a.d[i];
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> operator+(const Dual<S, N>& a, double c) {
  return {.v = a.v + c, .d = a.d};
}

template <class S, std::size_t N>
Dual<S, N> operator*(const Dual<S, N>& a, double c) {
  Dual<S, N> r{.v = a.v * c};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = a.d[i] * c;
  }
  return r;
}

// The derivatives are those of the smaller operand; of both, where intervals leave it open.
template <class S, std::size_t N>
Dual<S, N> smaller(const Dual<S, N>& a, const Dual<S, N>& b) {
  Dual<S, N> r{.v = smaller(a.v, b.v)};
  const Order which = order(a.v, b.v);
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = which == Order::first    ? a.d[i]
             : which == Order::second ? b.d[i]
                                      : hull(a.d[i], b.d[i]);
  }
  return r;
}

// The derivatives are those of the smaller operand at each of the points.
template <std::size_t N>
Dual<Pair, N> smaller(const Dual<Pair, N>& a, const Dual<Pair, N>& b) {
  const auto is_a = a.v <= b.v;
  Dual<Pair, N> r{.v = is_a ? a.v : b.v};
  for (std::size_t i = 0; i < N; ++i) {
    r.d[i] = is_a ? a.d[i] : b.d[i];
  }
  return r;
}

template <class S, std::size_t N>
Dual<S, N> power(const Dual<S, N>& a, int n) {
  return chain(a, power(value_of(a), n), power(value_of(a), n - 1) * static_cast<double>(n));
}

template <class S, std::size_t N>
Dual<S, N> square_root(const Dual<S, N>& a) {
  const S root = square_root(value_of(a));
  return chain(a, root, square_root_slope(root));
}

template <class S, std::size_t N>
Dual<S, N> sine(const Dual<S, N>& a) {
  const auto [value, slope] = sine_and_cosine(value_of(a));
  return chain(a, value, slope);
}

template <class S, std::size_t N>
Dual<S, N> cosine(const Dual<S, N>& a) {
  const auto [minus_slope, value] = sine_and_cosine(value_of(a));
  return chain(a, value, -minus_slope);
}

template <class S, std::size_t N>
Dual<S, N> exponential(const Dual<S, N>& a) {
  const S value = exponential(value_of(a));
  return chain(a, value, exponential_slope(value_of(a), value));
}

template <class S, std::size_t N>
Dual<S, N> logarithm(const Dual<S, N>& a) {
  return chain(a, logarithm(value_of(a)), logarithm_slope(value_of(a)));
}

template <class S, std::size_t N>
Dual<S, N> magnitude(const Dual<S, N>& a) {
  return chain(a, magnitude(value_of(a)), magnitude_slope(value_of(a)));
}

template <class S, std::size_t N>
Dual<S, N> real_power(const Dual<S, N>& a, double c) {
  return chain(a, real_power(value_of(a), c), real_power_slope(value_of(a), c));
}

template <class S, std::size_t N>
Dual<S, N> power_norm(const Dual<S, N>& a, const Dual<S, N>& b, double p) {
  const S& x = value_of(a);
  const S& y = value_of(b);
  return chain(a, b, power_norm(x, y, p), power_norm_slope(x, y, p), power_norm_slope(y, x, p));
}

}  // namespace tactus::rendering
