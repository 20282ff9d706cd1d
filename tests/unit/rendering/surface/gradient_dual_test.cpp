// A number with three derivatives, in pairs, against one with one derivative at a time.
#include "rendering/surface/gradient_dual.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace tactus::rendering {
namespace {

constexpr std::uint64_t kDualSeed = 20261127;
using Alone = Dual<double, 1>;

// One number in both representations.
struct Operand {
  GradientDual in_pairs;
  std::array<Alone, 3> alone;
};

Operand any_operand(std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  const double value = random() % 16U == 0 ? 0.0 : number(random);
  const double x = number(random);
  const double y = number(random);
  const double z = number(random);
  return {.in_pairs = {.value_and_x = Pair{value, x}, .yz = Pair{y, z}},
          .alone = {Alone{.v = value, .d = {x}}, Alone{.v = value, .d = {y}},
                    Alone{.v = value, .d = {z}}}};
}

// Returns true if two doubles have the same bits, or if both are no number.
bool has_same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

// Expects a rule to give the same bits in pairs and alone.
template <class Rule>
void expect_same_bits(const char* name, const Operand& a, const Operand& b, const Rule& rule) {
  const GradientDual r = rule(a.in_pairs, b.in_pairs);
  const std::array<double, 3> derivatives{r.value_and_x[1], r.yz[0], r.yz[1]};
  for (std::size_t i = 0; i < derivatives.size(); ++i) {
    const Alone expected = rule(a.alone.at(i), b.alone.at(i));
    ASSERT_TRUE(has_same_bits(value_of(r), expected.v)) << name;
    ASSERT_TRUE(has_same_bits(derivatives.at(i), expected.d[0])) << name << " along " << i;
  }
}

TEST(GradientDual, HasTheBitsOfItsNumbersAlone) {
  SCOPED_TRACE(kDualSeed);
  std::mt19937_64 random(kDualSeed);
  for (int run = 0; run < 20'000; ++run) {
    const Operand a = any_operand(random);
    const Operand b = any_operand(random);
    const double c = value_of(any_operand(random).in_pairs);
    const int n = 2 + static_cast<int>(random() % 8U);
    const auto expect = [&](const char* name, const auto& rule) {
      expect_same_bits(name, a, b, rule);
    };
    expect("sum", [](const auto& p, const auto& q) { return p + q; });
    expect("difference", [](const auto& p, const auto& q) { return p - q; });
    expect("product", [](const auto& p, const auto& q) { return p * q; });
    expect("quotient", [](const auto& p, const auto& q) { return p / q; });
    expect("negation", [](const auto& p, const auto&) { return -p; });
    expect("offset", [c](const auto& p, const auto&) { return p + c; });
    expect("scale", [c](const auto& p, const auto&) { return p * c; });
    expect("smaller", [](const auto& p, const auto& q) { return smaller(p, q); });
    expect("power", [n](const auto& p, const auto&) { return power(p, n); });
    expect("root", [](const auto& p, const auto&) { return square_root(p); });
    expect("sine", [](const auto& p, const auto&) { return sine(p); });
    expect("cosine", [](const auto& p, const auto&) { return cosine(p); });
    expect("exponential", [](const auto& p, const auto&) { return exponential(p); });
    expect("logarithm", [](const auto& p, const auto&) { return logarithm(p); });
    expect("magnitude", [](const auto& p, const auto&) { return magnitude(p); });
    expect("real power", [](const auto& p, const auto&) { return real_power(p, 1.5); });
    expect("norm", [](const auto& p, const auto& q) { return power_norm(p, q, 2.5); });
    if (::testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
