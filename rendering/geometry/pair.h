// Two doubles side by side. One operation acts on both, and gives each the bits that it would give
// the double alone; processors with vector instructions carry it out at once.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace tactus::rendering {

using Pair [[gnu::vector_size(16)]] = double;
// The bits of a pair.
using PairBits [[gnu::vector_size(16)]] = std::int64_t;

// Returns both doubles equal to x.
constexpr Pair both(double x) {
  return Pair{x, x};
}

// Loads two doubles from any address.
inline Pair pair_at(const double* place) {
  Pair pair;
  std::memcpy(&pair, place, sizeof pair);
  return pair;
}

// Returns the sum of both squares.
inline double squared_norm(Pair p) {
  const Pair squares = p * p;
  return squares[0] + squares[1];
}

// Returns (b, a) for (a, b).
inline Pair swapped(Pair p) {
  return Pair{p[1], p[0]};
}

// Returns the larger, and the smaller, at each place; b where one of the two is not a number.
inline Pair larger(Pair a, Pair b) {
  return a > b ? a : b;
}
inline Pair smaller(Pair a, Pair b) {
  return a < b ? a : b;
}

// Returns the absolute value at each place.
inline Pair magnitude(Pair p) {
  constexpr std::int64_t kAllButTheSign = 0x7fff'ffff'ffff'ffff;
  return std::bit_cast<Pair>(std::bit_cast<PairBits>(p) & PairBits{kAllButTheSign, kAllButTheSign});
}

}  // namespace tactus::rendering
