// Formulas with poles, cusps and places outside a function's domain: each is refused with the place
// of a pole, or its proxy is never held where nothing is in its way. The oracle is brute force: F
// at thousands of points between the proxy and a tool at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include "host_tools/bake/formula/formula_parser.h"
#include "host_tools/bake/formula/pole_search.h"
#include "host_tools/input_error.h"
#include "rendering/contact/implicit_tracking.h"
#include "tests/support/share.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;
using rendering::ImplicitSurface;
using rendering::ImplicitTracker;
using rendering::Sides;

constexpr std::uint64_t kTrapSeed = 20261126;
constexpr double kScale_m = 0.03;

ImplicitSurface surface_of(const Formula& formula, Sides sides) {
  return {.formula = formula.view(),
          .bounds_O = {.lower = Vec3::Constant(-2.0), .upper = Vec3::Constant(2.0)},
          .scale_m = kScale_m,
          .sides = sides};
}

Vec3 random_point(std::mt19937_64& random, double side) {
  std::uniform_real_distribution<double> unit(-side, side);
  const double x = unit(random);
  const double y = unit(random);
  return {x, y, unit(random)};
}

// Returns true if F is above 0 on the whole segment from `from` to `to` within the bounds (object
// frame), and at no sample as near to 0 as to its neighbours, where it may touch 0 between them.
// The samples are dense at the beginning, where the proxy lies at its rest height above a surface.
bool is_free(const ImplicitSurface& surface, double side, const Vec3& from, const Vec3& to) {
  constexpr int kSamples = 4'000;
  constexpr double kSteepest = 3.0;
  const auto F = [&](int k) {
    const double t = std::pow(10.0, -8.0 * (1.0 - static_cast<double>(k) / kSamples));
    const Vec3 p = from + t * (to - from);
    return surface.bounds_O.contains(p) ? side * evaluate(surface.formula, p) : 1e300;
  };
  double before = F(0);
  double here = F(1);
  for (int k = 1; k < kSamples; ++k) {
    const double next = F(k + 1);
    if (!(here > kSteepest * (std::abs(next - here) + std::abs(here - before)))) {
      return false;
    }
    before = here;
    here = next;
  }
  return true;
}

// Moves the tool about and lets it rest at random places. Returns the place of a tool that is still
// pulled after a hundred ticks though the proxy's path to it is free.
std::optional<Vec3> place_of_trap(const ImplicitSurface& surface, std::mt19937_64& random) {
  constexpr double kArrived_m = 1e-6;
  ImplicitTracker tracker;
  tracker.place(kScale_m * random_point(random, 2.2));
  for (int rest = 0; rest < 4; ++rest) {
    for (int jump = 0; jump < 5; ++jump) {
      tracker.advance(surface, {}, kScale_m * random_point(random, 2.2));
    }
    Vec3 tool_O = random_point(random, 2.2);
    rendering::ImplicitRest end;
    for (int tick = 0; tick < 100; ++tick) {
      end = tracker.advance(surface, {}, kScale_m * tool_O);
    }
    const Vec3 proxy_O = surface.to_object(end.proxy_W);
    if (end.planes == 0 || (end.proxy_W - kScale_m * tool_O).norm() < kArrived_m) {
      continue;
    }
    const double side = evaluate(surface.formula, proxy_O) < 0.0 ? -1.0 : 1.0;
    // A tool within a solid is not held.
    if ((surface.sides == Sides::one && side < 0.0) || is_free(surface, side, proxy_O, tool_O)) {
      return tool_O;
    }
  }
  return std::nullopt;
}

// Returns by how much f changes near a place; infinity if it is not a number there.
double change_near(const FormulaView& formula, const Vec3& place, std::mt19937_64& random) {
  constexpr double kNear = 4e-6;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double least = kInfinity;
  double largest = -kInfinity;
  for (int i = 0; i < 2000; ++i) {
    const double f = evaluate(formula, place + random_point(random, kNear));
    least = std::isnan(f) ? -kInfinity : std::min(least, f);
    largest = std::isnan(f) ? kInfinity : std::max(largest, f);
  }
  return largest - least;
}

struct Case {
  const char* text = "";
  bool has_pole = false;
};

// Poles of odd and even order, on planes, lines and points; poles out of reach within the solid;
// cusps; functions outside their domain; surfaces that touch themselves.
constexpr auto kCases = std::to_array<Case>({
    {"1/x^2 - 1", true},
    {"1/x", true},
    {"1/x - y", true},
    {"y/x - 1", true},
    {"x*y/(x^2 + y^2)", true},
    {"1/(x^2 + y^2 + z^2) - 1", true},
    {"1/(x - 0.3)^3 + y", true},
    {"z - 0.2/(0.1 + x)", true},
    {"z - tan(2*x)", true},
    {"exp(1/x) - 2", true},
    {"1 - 0.3/(x^2 + y^2 + z^2)", false},
    {"1 - 0.2/((x - 0.5)^2 + y^2 + z^2) - 0.2/((x + 0.5)^2 + y^2 + z^2)", false},
    {"z - 1/(x^2 + y^2 + 0.01)", false},
    {"sqrt(x) - 0.5", false},
    {"log(x) + y", false},
    {"z - sqrt(1 - x^2 - y^2)", false},
    {"abs(x)^0.3 + abs(y)^0.3 - 1", false},
    {"z - sqrt(abs(x))", false},
    {"y^2 - x^3", false},
    {"x^2*y^2 - z^3", false},
    {"max(x, 0) + max(y, 0) - 0.5", false},
    {"heart()", false},
});

TEST(FormulaTrap, FormulasWithPolesAreRefusedWithThePlaceAndOthersHoldNoProxy) {
  std::mt19937_64 random(kTrapSeed);
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.text);
    const Formula formula = parse_formula(c.text);
    const ImplicitSurface surface = surface_of(formula, Sides::one);
    const auto pole = find_pole(surface.formula, surface.bounds_O, Sides::one);
    EXPECT_EQ(pole.has_value(), c.has_pole);
    if (pole) {
      EXPECT_GT(change_near(surface.formula, *pole, random), 0.5) << pole->transpose();
      continue;
    }
    for (int run = 0; run < testing::part_of(20); ++run) {
      const auto trap = place_of_trap(surface, random);
      ASSERT_FALSE(trap) << trap->transpose();
    }
  }
}

// A random formula of up to a few levels.
std::string random_text(std::mt19937_64& random, int levels) {
  const auto part = [&] { return random_text(random, levels - 1); };
  if (levels == 0 || random() % 8 == 0) {
    constexpr std::array kLeaves{"x", "y", "z", "x", "y", "z", "0.7", "1.3"};
    return kLeaves[random() % kLeaves.size()];
  }
  switch (random() % 13) {
    case 0:
    case 1:
      return "(" + part() + " + " + part() + ")";
    case 2:
    case 3:
      return "(" + part() + " - " + part() + ")";
    case 4:
    case 5:
      return part() + "*" + part();
    case 6:
      return "(" + part() + ")/(" + part() + ")";
    case 7:
      return "(" + part() + ")^2";
    case 8:
      return "sqrt(" + part() + ")";
    case 9:
      return "sin(3*" + part() + ")";
    case 10:
      return "log(" + part() + ")";
    case 11:
      return "abs(" + part() + ")^0.4";
    default:
      return "exp(" + part() + ")";
  }
}

TEST(FormulaTrap, ThousandRandomFormulasAreRefusedForAPoleOrHoldNoProxy) {
  SCOPED_TRACE(kTrapSeed);
  std::mt19937_64 random(kTrapSeed);
  int refused = 0;
  int poles = 0;
  int touched = 0;
  const int formulas = testing::part_of(1000);
  for (int i = 0; i < formulas; ++i) {
    // One that does not depend on the place is no formula.
    const std::string text = "(" + random_text(random, 4) + ") + x - x*0.99";
    SCOPED_TRACE(text);
    Formula formula;
    try {
      formula = parse_formula(text);
    } catch (const InputError&) {
      continue;  // such as a division by a constant 0
    }
    const Sides sides = i % 2 == 0 ? Sides::one : Sides::two;
    const ImplicitSurface surface = surface_of(formula, sides);
    if (const auto pole = find_pole(surface.formula, surface.bounds_O, sides)) {
      ++refused;
      poles += change_near(surface.formula, *pole, random) > 0.5 ? 1 : 0;
      continue;
    }
    ++touched;
    const auto trap = place_of_trap(surface, random);
    EXPECT_FALSE(trap) << trap->transpose();
  }
  std::printf("%d formulas touched, %d refused, of which %d change at once there\n", touched,
              refused, poles);
  EXPECT_GT(touched, formulas / 2);
}

}  // namespace
}  // namespace tactus::host
