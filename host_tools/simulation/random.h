// The simulation's own pseudo-random numbers. The distributions of the standard library may differ
// from one library to the next, while the same seed must give the same bits everywhere.
#pragma once

#include <cstdint>

namespace tactus::host {

// The generator SplitMix64 (Steele, Lea, Flood, OOPSLA 2014). Its state is one 64-bit word, every
// seed is good, and it passes BigCrush.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  // Returns 64 random bits.
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  // Returns a number in [lower, upper), made from the 53 high bits.
  double uniform(double lower, double upper) {
    constexpr double kTwoToMinus53 = 0x1.0p-53;
    return lower + (upper - lower) * (static_cast<double>(next() >> 11U) * kTwoToMinus53);
  }

 private:
  std::uint64_t state_;
};

}  // namespace tactus::host
