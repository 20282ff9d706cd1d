// A generator whose seed is printed and can be given: TACTUS_SEED=7 hal_tests.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

namespace tactus::hal {

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(chosen(seed)), engine_(seed_) {
    std::cout << "seed " << seed_ << '\n';
  }

  std::uint64_t seed() const { return seed_; }

  // Returns a random number from 0 to `count` - 1.
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
  }
  bool one_in(std::size_t count) { return below(count) == 0; }
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }

 private:
  static std::uint64_t chosen(std::uint64_t seed) {
    const char* given = std::getenv("TACTUS_SEED");
    return given == nullptr ? seed : std::stoull(given);
  }

  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace tactus::hal
