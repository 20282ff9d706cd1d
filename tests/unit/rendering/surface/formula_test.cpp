// Instruction lists: what check() lets through, and what intervals promise about values.
#include "rendering/surface/formula.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace tactus::rendering {
namespace {

using List = std::vector<Instruction>;

constexpr std::uint64_t kFormulaSeed = 20260319;

FormulaFault fault_of(const List& list) {
  const auto good = check({list});
  EXPECT_FALSE(good.has_value());
  return good ? FormulaFault::empty : good.error().fault;
}

List coordinates() {
  return {{.opcode = Opcode::x}, {.opcode = Opcode::y}, {.opcode = Opcode::z}};
}

TEST(FormulaCheck, LetsAGoodListPass) {
  List list = coordinates();
  list.push_back({.opcode = Opcode::add, .a = 0, .b = 2});
  EXPECT_TRUE(check({list}).has_value());
}

TEST(FormulaCheck, RefusesAnEmptyListAndOneThatIsTooLong) {
  EXPECT_EQ(fault_of({}), FormulaFault::empty);
  EXPECT_TRUE(check({List(kMaxFormulaInstructions)}).has_value());
  EXPECT_EQ(fault_of(List(kMaxFormulaInstructions + 1)), FormulaFault::too_long);
}

TEST(FormulaCheck, RefusesAnUnknownOpcode) {
  for (int opcode = kOpcodes; opcode < 256; ++opcode) {
    EXPECT_EQ(fault_of({{.opcode = static_cast<Opcode>(opcode)}}), FormulaFault::opcode);
  }
}

TEST(FormulaCheck, RefusesOperandsThatAreNotEarlierResults) {
  for (auto opcode = static_cast<std::uint8_t>(Opcode::add); opcode < kOpcodes; ++opcode) {
    for (const std::uint16_t operand : {std::uint16_t{3}, std::uint16_t{4}, std::uint16_t{65535}}) {
      List list = coordinates();
      list.push_back(
          {.opcode = static_cast<Opcode>(opcode), .a = operand, .exponent = 2, .constant = 2.0});
      EXPECT_EQ(fault_of(list), FormulaFault::operand);
      list.back() = {
          .opcode = static_cast<Opcode>(opcode), .b = operand, .exponent = 2, .constant = 2.0};
      EXPECT_EQ(fault_of(list), FormulaFault::operand) << "also where b is not used";
    }
  }
}

TEST(FormulaCheck, RefusesConstantsThatAreNotFinite) {
  for (const double c :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(fault_of({{.opcode = Opcode::constant, .constant = c}}), FormulaFault::constant);
    EXPECT_EQ(fault_of({{.opcode = Opcode::x}, {.opcode = Opcode::scale, .constant = c}}),
              FormulaFault::constant);
  }
  EXPECT_EQ(fault_of({{.opcode = Opcode::x}, {.opcode = Opcode::power_norm, .constant = 0.5}}),
            FormulaFault::constant);
}

TEST(FormulaCheck, RefusesExponentsOutOfRange) {
  for (const int n : {-32768, -1, 0, 1, kMaxExponent + 1, 32767}) {
    EXPECT_EQ(fault_of({{.opcode = Opcode::x},
                        {.opcode = Opcode::power, .exponent = static_cast<std::int16_t>(n)}}),
              FormulaFault::exponent);
  }
}

TEST(FormulaCheck, WhatItLetsThroughOfRandomBytesCanBeEvaluated) {
  SCOPED_TRACE(kFormulaSeed);
  std::mt19937_64 random(kFormulaSeed);
  std::size_t passed = 0;
  for (int run = 0; run < 200'000; ++run) {
    List list = coordinates();
    const auto more = static_cast<std::size_t>(random() % 6);
    for (std::size_t i = 0; i < more; ++i) {
      auto instruction =
          std::bit_cast<Instruction>(std::array<std::uint64_t, 2>{random(), random()});
      // Near enough to what is right that some lists pass.
      instruction.opcode = static_cast<Opcode>(random() % (kOpcodes + 1U));
      instruction.a %= static_cast<std::uint16_t>(list.size() + 1);
      instruction.b = static_cast<std::uint16_t>(random() % 2 == 0 ? 0 : instruction.b % 4);
      instruction.exponent = static_cast<std::int16_t>(instruction.exponent % 70);
      list.push_back(instruction);
    }
    if (check({list})) {
      ++passed;
      const Vec3 p{0.3, -0.7, 1.1};
      const double value = evaluate({list}, p);
      const double again = evaluate_gradient({list}, p).value;
      ASSERT_TRUE(value == again || (std::isnan(value) && std::isnan(again)));
      evaluate_along({list}, p, {1.0, 2.0, 3.0}, {0.0, 1.0});
    }
  }
  EXPECT_GT(passed, 50'000U);
}

// A random list in which every operation can occur.
List random_list(std::mt19937_64& random) {
  std::uniform_real_distribution<double> constant(-3.0, 3.0);
  List list = coordinates();
  const auto size = static_cast<std::size_t>(4U + random() % 12U);
  while (list.size() < size) {
    Instruction i{.opcode = static_cast<Opcode>(random() % kOpcodes), .constant = constant(random)};
    const auto operand = [&] { return static_cast<std::uint16_t>(random() % list.size()); };
    i.exponent = static_cast<std::int16_t>(2U + random() % 5U);
    i.a = operand();
    i.b = operand();
    if (i.opcode == Opcode::power_norm) {
      i.constant = std::copysign(1.0 + std::abs(i.constant), i.constant);
    }
    list.push_back(i);
    if (!check({list})) {
      list.back().b = 0;
    }
    if (!check({list})) {
      list.back().a = 0;
    }
  }
  return list;
}

// Returns true if two doubles have the same bits, or if both are no number.
bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

TEST(FormulaValues, AtTwoPointsAtOnceHaveTheBitsOfEachPointAlone) {
  SCOPED_TRACE(kFormulaSeed);
  std::mt19937_64 random(kFormulaSeed);
  std::uniform_real_distribution<double> side(-2.0, 2.0);
  for (int run = 0; run < 20'000; ++run) {
    const List list = random_list(random);
    const Vec3 p{side(random), side(random), side(random)};
    const Vec3 q{side(random), side(random), side(random)};
    const auto both_of = evaluate_gradients({list}, p, q);
    const ValueAndGradient at_p = evaluate_gradient({list}, p);
    const ValueAndGradient at_q = evaluate_gradient({list}, q);
    ASSERT_TRUE(is_same(both_of[0].value, at_p.value)) << "run " << run;
    ASSERT_TRUE(is_same(both_of[1].value, at_q.value)) << "run " << run;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(is_same(both_of[0].gradient[axis], at_p.gradient[axis])) << "run " << run;
      ASSERT_TRUE(is_same(both_of[1].gradient[axis], at_q.gradient[axis])) << "run " << run;
    }
  }
}

bool holds(const Interval& range, double value, double slack) {
  return range.lower() - slack <= value && value <= range.upper() + slack;
}

TEST(FormulaRanges, HoldTheValueAndTheSlopeAtEveryPointOfASegment) {
  SCOPED_TRACE(kFormulaSeed);
  std::mt19937_64 random(kFormulaSeed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_real_distribution<double> side(-2.0, 2.0);
  int tight = 0;
  for (int run = 0; run < 60'000; ++run) {
    const List list = random_list(random);
    ASSERT_TRUE(check({list}).has_value());
    const Vec3 from{side(random), side(random), side(random)};
    const Vec3 motion =
        std::pow(10.0, -6.0 * unit(random)) * Vec3{side(random), side(random), side(random)};
    const double a = unit(random);
    const double b = a + (1.0 - a) * unit(random);
    const SegmentRange range = evaluate_along({list}, from, motion, {a, b});
    ASSERT_LE(range.value.lower(), range.value.upper());
    ASSERT_LE(range.slope.lower(), range.slope.upper());
    tight += std::isfinite(range.slope.lower()) && std::isfinite(range.slope.upper()) ? 1 : 0;
    for (int k = 0; k <= 10; ++k) {
      const double t = k == 0 ? a : k == 10 ? b : a + (b - a) * unit(random);
      const ValueAndGradient f = evaluate_gradient({list}, from + t * motion);
      const double slope = f.gradient.dot(motion);
      if (!std::isnan(f.value)) {
        ASSERT_TRUE(holds(range.value, f.value, 0.0)) << "run " << run << " t " << t;
      }
      // The dot product rounds too.
      const double slack = 1e-9 * (f.gradient.norm() * motion.norm()) + 1e-200;
      if (std::isfinite(slope) && std::isfinite(slack)) {
        ASSERT_TRUE(holds(range.slope, slope, slack)) << "run " << run << " t " << t;
      }
    }
    const Interval box =
        evaluate_box({list}, from.cwiseMin(from + motion), from.cwiseMax(from + motion));
    const double inside = evaluate({list}, from + 0.5 * motion);
    ASSERT_TRUE(std::isnan(inside) || holds(box, inside, 1e-12 * std::abs(inside)));
  }
  EXPECT_GT(tight, 20'000);
}

TEST(FormulaRanges, ShrinkWithTheSegment) {
  // x^3 y - sin(z): the range of the slope narrows as fast as the segment.
  List list = coordinates();
  list.push_back({.opcode = Opcode::power, .a = 0, .exponent = 3});
  list.push_back({.opcode = Opcode::multiply, .a = 3, .b = 1});
  list.push_back({.opcode = Opcode::sine, .a = 2});
  list.push_back({.opcode = Opcode::subtract, .a = 4, .b = 5});
  const Vec3 from{0.5, 0.8, 1.0};
  const auto width = [&](double length) {
    const Interval slope = evaluate_along({list}, from, {1.0, 1.0, 1.0}, {0.0, length}).slope;
    return slope.upper() - slope.lower();
  };
  EXPECT_LT(width(1e-3), 0.011 * width(1e-1));
}

}  // namespace
}  // namespace tactus::rendering
