#include "host_tools/bake/formula/formula_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "host_tools/units.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;
using rendering::Instruction;
using rendering::Opcode;

// The grid has this many points along a side. The number is odd: the middle is one of them.
constexpr int kPoints = 21;

// Calls `look` with every point of the grid and whether it is on the border, until it returns true.
template <class Look>
bool any_point(const Box& bounds, Look look) {
  const Vec3 step = (bounds.upper - bounds.lower) / (kPoints - 1);
  for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
    const std::array<int, 3> at{i % kPoints, i / kPoints % kPoints, i / (kPoints * kPoints)};
    const bool on_border =
        std::ranges::any_of(at, [](int k) { return k == 0 || k == kPoints - 1; });
    const Vec3 p = bounds.lower +
                   step.cwiseProduct(Vec3{static_cast<double>(at[0]), static_cast<double>(at[1]),
                                          static_cast<double>(at[2])});
    if (look(p, on_border)) {
      return true;
    }
  }
  return false;
}

// Returns the operand's value: the instructions up to it are a formula of their own.
double operand(const FormulaView& formula, std::uint16_t number, const Vec3& p) {
  return rendering::evaluate({formula.instructions.first(number + std::size_t{1})}, p);
}

// A function with a border: its name, and its value beyond.
struct Domain {
  Opcode opcode = Opcode::square_root;
  std::string_view name;
  std::string_view beyond;
};
constexpr std::array kDomains{
    Domain{Opcode::square_root, "sqrt", "of a number below 0, which counts as 0"},
    Domain{Opcode::logarithm, "log", "of a number that is not above 0, which counts as -708"},
    Domain{Opcode::real_power, "a power with a broken exponent",
           "of a number below 0, which counts as the power of 0"},
    Domain{Opcode::power_norm, "ricci", "of a number below 0, which counts as 0"},
    Domain{Opcode::sine, "sin", "of more than a million radians, which is no number"},
    Domain{Opcode::cosine, "cos", "of more than a million radians, which is no number"},
};

bool is_beyond(Opcode opcode, double a) {
  switch (opcode) {
    case Opcode::logarithm:
      return a <= 0.0;
    case Opcode::sine:
    case Opcode::cosine:
      return std::abs(a) > rendering::kLargestAngle;
    default:
      return a < 0.0;
  }
}

// Returns a point where an operand of the instruction is outside the function's domain.
std::optional<Vec3> point_beyond(const FormulaView& formula, const Box& bounds,
                                 const Instruction& instruction) {
  // A negative number that is only rounding is none.
  constexpr double kRounding = 1e-12;
  std::optional<Vec3> beyond;
  const auto is_out = [&](std::uint16_t number, const Vec3& p) {
    const double a = operand(formula, number, p);
    return is_beyond(instruction.opcode, a + (std::abs(a) < kRounding ? kRounding : 0.0));
  };
  any_point(bounds, [&](const Vec3& p, bool /*on_border*/) {
    if (is_out(instruction.a, p) ||
        (instruction.opcode == Opcode::power_norm && is_out(instruction.b, p))) {
      beyond = p;
    }
    return beyond.has_value();
  });
  return beyond;
}

// Returns true if the whole border is solid and some point within is not.
bool seems_swapped(const FormulaView& formula, const Box& bounds) {
  const bool free_on_border = any_point(bounds, [&](const Vec3& p, bool on_border) {
    return on_border && !(evaluate(formula, p) < 0.0);
  });
  return !free_on_border && any_point(bounds, [&](const Vec3& p, bool /*on_border*/) {
    return evaluate(formula, p) > 0.0;
  });
}

}  // namespace

std::string place_text(const Vec3& place, const Box& bounds) {
  constexpr double kZeroShare = 1e-6;
  const double zero = kZeroShare * (bounds.upper - bounds.lower).maxCoeff();
  const Vec3 p = (place.array().abs() < zero).select(0.0, place);
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

std::vector<std::string> formula_warnings(const FormulaView& formula, const Box& bounds,
                                          rendering::Sides sides) {
  std::vector<std::string> warnings;
  for (const Domain& domain : kDomains) {
    for (const Instruction& instruction : formula.instructions) {
      if (instruction.opcode != domain.opcode) {
        continue;
      }
      if (const auto beyond = point_beyond(formula, bounds, instruction)) {
        warnings.push_back(
            fmt::format("at {} the formula takes {} {}; if that is not wanted, narrow the bounds "
                        "or write max(..., 0) around the argument",
                        place_text(*beyond, bounds), domain.name, domain.beyond));
        break;
      }
    }
  }
  if (sides == rendering::Sides::one && seems_swapped(formula, bounds)) {
    warnings.emplace_back(
        "the formula is below 0, which is solid, on the whole border of its bounds, and above 0 "
        "only within: a tool outside feels nothing. If inside and outside are swapped, write "
        "-(...) around the formula");
  }
  return warnings;
}

std::string why_nowhere_zero(const ZeroSearch& zero, const Box& bounds, double unit_m) {
  const std::string place = place_text(zero.place, bounds);
  const std::string_view side = zero.value > 0.0 ? "above" : "below";
  switch (zero.kind) {
    case ZeroKind::crossed:
      return fmt::format("the formula changes its sign at {}", place);
    case ZeroKind::touched:
      return fmt::format(
          "the formula touches 0 at {} and never changes its sign, so it has no inside; write "
          "contact = \"tracking\", which feels it as a wall, or subtract a little, as in x^2 - "
          "0.001^2, which is a wall 0.002 thick",
          place);
    case ZeroKind::flat:
      return fmt::format(
          "the formula is 0 in a whole region about {} and was not found to change its sign, so it "
          "has no surface; subtract a little",
          place);
    case ZeroKind::none:
      return fmt::format(
          "the formula is {} 0 everywhere within its bounds, nearest to it at {} with {:.4g}; "
          "interval arithmetic proves it; correct it, or widen bounds",
          side, place, zero.value);
    default:
      return fmt::format(
          "the formula is {} 0 wherever it was looked at within its bounds, nearest to it at {} "
          "with {:.4g}; nothing is proved of parts of {:.2g} mm and less, one of them at {}; "
          "correct it, narrow the bounds, or widen them",
          side, place, zero.value, kMillimetresPerMetre * unit_m * zero.undecided_size,
          place_text(zero.undecided, bounds));
  }
}

}  // namespace tactus::host
