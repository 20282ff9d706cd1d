// Four floats at a time, which the compiler turns into the vector instructions of the machine, or
// into four times one: the bits are the same.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#include "rendering/geometry/pair.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The four lanes of a vector register; the comparison of two Floats gives Integers.
using Floats [[gnu::vector_size(16)]] = float;
using Integers [[gnu::vector_size(16)]] = std::int32_t;

// Returns the value in all four lanes.
inline Floats all(float value) {
  return Floats{value, value, value, value};
}

// Loads four floats from any address.
inline Floats floats_at(const float* place) {
  Floats floats;
  std::memcpy(&floats, place, sizeof floats);
  return floats;
}

// Returns two pairs of doubles as four floats, each rounded to the nearest.
inline Floats rounded(Pair low, Pair high) {
#ifdef __SSE2__
  return __builtin_shufflevector(__builtin_ia32_cvtpd2ps(low), __builtin_ia32_cvtpd2ps(high), 0, 1,
                                 4, 5);
#else
  return Floats{static_cast<float>(low[0]), static_cast<float>(low[1]), static_cast<float>(high[0]),
                static_cast<float>(high[1])};
#endif
}

// Stores four floats at any address.
inline void store(Floats floats, float* place) {
  std::memcpy(place, &floats, sizeof floats);
}

// Loads two floats from each of two addresses.
inline Floats two_and_two(const float* low, const float* high) {
  double first = 0.0;
  double second = 0.0;
  std::memcpy(&first, low, sizeof first);
  std::memcpy(&second, high, sizeof second);
  return std::bit_cast<Floats>(Pair{first, second});
}

// Loads four floats from an aligned address.
inline Floats aligned_floats_at(const float* place) {
  return floats_at(std::assume_aligned<alignof(Floats)>(place));
}

// Returns a bit for every lane that holds, lane 0 in the lowest; all bits of a lane must be equal.
inline std::uint32_t which(Integers answers) {
#ifdef __SSE__
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(std::bit_cast<Floats>(answers)));
#else
  constexpr Integers kBits{1, 2, 4, 8};
  const Integers bits = answers & kBits;
  return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

// Returns the number of the lowest set bit; `bits` must not be 0.
inline std::uint32_t lowest(std::uint32_t bits) {
  return static_cast<std::uint32_t>(std::countr_zero(bits));
}

// Return the smaller and the larger, lane by lane; no lane may be NaN.
inline Floats least(Floats a, Floats b) {
  return a < b ? a : b;
}
inline Floats most(Floats a, Floats b) {
  return a > b ? a : b;
}

// Returns the absolute values: the sign bits are cleared.
inline Floats magnitude(Floats a) {
  return std::bit_cast<Floats>(std::bit_cast<Integers>(a) & 0x7fff'ffff);
}

// Returns the square roots; no lane may be negative.
inline Floats root(Floats squared) {
  return Floats{std::sqrt(squared[0]), std::sqrt(squared[1]), std::sqrt(squared[2]),
                std::sqrt(squared[3])};
}

// Four points or directions, component by component: lane i of x, y and z is vector i.
struct FourVectors {
  Floats x;
  Floats y;
  Floats z;
};

// Returns the four dot products.
inline Floats dot(const FourVectors& a, const FourVectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Returns one vector, rounded to float, four times.
inline FourVectors four(const Vec3& v) {
  return {all(static_cast<float>(v.x())), all(static_cast<float>(v.y())),
          all(static_cast<float>(v.z()))};
}

// Returns four vectors side by side: a transposition of 4 x 3 numbers.
inline FourVectors four(const Float3& a, const Float3& b, const Float3& c, const Float3& d) {
  // x and y of two vectors fill one register.
  const Floats xy_ab = two_and_two(&a.x, &b.x);
  const Floats xy_cd = two_and_two(&c.x, &d.x);
  return {__builtin_shufflevector(xy_ab, xy_cd, 0, 2, 4, 6),
          __builtin_shufflevector(xy_ab, xy_cd, 1, 3, 5, 7), Floats{a.z, b.z, c.z, d.z}};
}

}  // namespace tactus::rendering
