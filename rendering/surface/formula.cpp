#include "rendering/surface/formula.h"

#include <array>
#include <cmath>
#include <utility>

#include "rendering/surface/dual.h"
#include "rendering/surface/elementary.h"
#include "rendering/surface/gradient_dual.h"

namespace tactus::rendering {
namespace {

using AlongSegment = Dual<Interval, 1>;
using TwoGradients = Dual<Pair, 3>;

constexpr Opcode kFirstBinary = Opcode::add;
constexpr Opcode kLastBinary = Opcode::divide;

bool uses_a(Opcode opcode) {
  return opcode >= kFirstBinary;
}

bool uses_b(Opcode opcode) {
  return (opcode >= kFirstBinary && opcode <= kLastBinary) || opcode == Opcode::minimum ||
         opcode == Opcode::maximum || opcode == Opcode::power_norm;
}

bool uses_constant(Opcode opcode) {
  return opcode == Opcode::constant || opcode == Opcode::offset || opcode == Opcode::scale ||
         opcode == Opcode::real_power || opcode == Opcode::power_norm;
}

// Checks one instruction; returns its fault, or nothing if it is good.
std::expected<void, FormulaFault> check_one(const Instruction& instruction, std::size_t number) {
  const Opcode opcode = instruction.opcode;
  if (static_cast<std::uint8_t>(opcode) >= kOpcodes) {
    return std::unexpected(FormulaFault::opcode);
  }
  // Those that it does not use are 0.
  const bool a_good = uses_a(opcode) ? instruction.a < number : instruction.a == 0;
  const bool b_good = uses_b(opcode) ? instruction.b < number : instruction.b == 0;
  if (!a_good || !b_good) {
    return std::unexpected(FormulaFault::operand);
  }
  const bool small_norm = opcode == Opcode::power_norm && !(std::abs(instruction.constant) >= 1.0);
  if (uses_constant(opcode) && (!std::isfinite(instruction.constant) || small_norm)) {
    return std::unexpected(FormulaFault::constant);
  }
  if (opcode == Opcode::power &&
      (instruction.exponent < 2 || instruction.exponent > kMaxExponent)) {
    return std::unexpected(FormulaFault::exponent);
  }
  return {};
}

template <class Number>
Number constant_number(double c);

template <>
double constant_number(double c) {
  return c;
}
template <>
Interval constant_number(double c) {
  return {c, c};
}
template <>
GradientDual constant_number(double c) {
  return {.value_and_x = Pair{c, 0.0}};
}
template <>
TwoGradients constant_number(double c) {
  return {.v = both(c)};
}
template <>
AlongSegment constant_number(double c) {
  return {.v = {c, c}};
}

// Any kind of number that has the operations of dual.h.
template <class Number>
struct Coordinates {
  Number x;
  Number y;
  Number z;
};

// a and b are only looked at where the opcode uses them.
template <class Number>
inline Number carry_out(const Instruction& i, const Number& a, const Number& b,
                        const Coordinates<Number>& at) {
  switch (i.opcode) {
    case Opcode::constant:
      return constant_number<Number>(i.constant);
    case Opcode::x:
      return at.x;
    case Opcode::y:
      return at.y;
    case Opcode::z:
      return at.z;
    case Opcode::add:
      return a + b;
    case Opcode::subtract:
      return a - b;
    case Opcode::multiply:
      return a * b;
    case Opcode::divide:
      return a / b;
    case Opcode::negate:
      return -a;
    case Opcode::offset:
      return a + i.constant;
    case Opcode::scale:
      return a * i.constant;
    case Opcode::power:
      return power(a, i.exponent);
    case Opcode::square_root:
      return square_root(a);
    case Opcode::sine:
      return sine(a);
    case Opcode::cosine:
      return cosine(a);
    case Opcode::exponential:
      return exponential(a);
    case Opcode::logarithm:
      return logarithm(a);
    case Opcode::magnitude:
      return magnitude(a);
    case Opcode::minimum:
      return smaller(a, b);
    case Opcode::maximum:
      return -smaller(-a, -b);
    case Opcode::real_power:
      return real_power(a, i.constant);
    case Opcode::power_norm:
      return power_norm(a, b, i.constant);
  }
  std::unreachable();  // no opcode that check() lets through
}

template <class Number>
Number run(std::span<const Instruction> instructions, const Coordinates<Number>& at) {
  // Left uninitialised on purpose: every result is written before it is read.
  union Results {
    Results() {}
    std::array<Number, kMaxFormulaInstructions> of;
  } results;
  Number* result = results.of.data();
  for (const Instruction& i : instructions) {
    *result++ = carry_out(i, results.of[i.a], results.of[i.b], at);
  }
  return *(result - 1);
}

AlongSegment coordinate_along(double from, double segment, const Interval& t) {
  // The point of a segment is rounded, and so is its end.
  constexpr double kUlps = 8.0;
  const double lower = from + (segment < 0.0 ? t.upper() : t.lower()) * segment;
  const double upper = from + (segment < 0.0 ? t.lower() : t.upper()) * segment;
  const double slack = kUlps * 0x1p-52 * (std::abs(from) + std::abs(segment));
  return {.v = {lower - slack, upper + slack}, .d = {Interval{segment, segment}}};
}

}  // namespace

std::expected<void, FormulaError> check(const FormulaView& formula) {
  const std::size_t size = formula.instructions.size();
  if (size == 0) {
    return std::unexpected(FormulaError{.fault = FormulaFault::empty});
  }
  if (size > kMaxFormulaInstructions) {
    return std::unexpected(
        FormulaError{.fault = FormulaFault::too_long, .place = kMaxFormulaInstructions});
  }
  for (std::size_t i = 0; i < size; ++i) {
    if (const auto good = check_one(formula.instructions[i], i); !good) {
      return std::unexpected(FormulaError{.fault = good.error(), .place = i});
    }
  }
  return {};
}

double evaluate(const FormulaView& formula, const Vec3& p) {
  return run<double>(formula.instructions, {p.x(), p.y(), p.z()});
}

ValueAndGradient evaluate_gradient(const FormulaView& formula, const Vec3& p) {
  const auto f = run<GradientDual>(formula.instructions,
                                   {{.value_and_x = Pair{p.x(), 1.0}, .yz = Pair{0.0, 0.0}},
                                    {.value_and_x = Pair{p.y(), 0.0}, .yz = Pair{1.0, 0.0}},
                                    {.value_and_x = Pair{p.z(), 0.0}, .yz = Pair{0.0, 1.0}}});
  return {.value = value_of(f), .gradient = Vec3{f.value_and_x[1], f.yz[0], f.yz[1]}};
}

std::array<ValueAndGradient, 2> evaluate_gradients(const FormulaView& formula, const Vec3& p,
                                                   const Vec3& q) {
  const Pair one = both(1.0);
  const Pair none = both(0.0);
  const auto f = run<TwoGradients>(formula.instructions,
                                   {TwoGradients{.v = Pair{p.x(), q.x()}, .d = {one, none, none}},
                                    TwoGradients{.v = Pair{p.y(), q.y()}, .d = {none, one, none}},
                                    TwoGradients{.v = Pair{p.z(), q.z()}, .d = {none, none, one}}});
  return {ValueAndGradient{.value = f.v[0], .gradient = Vec3{f.d[0][0], f.d[1][0], f.d[2][0]}},
          ValueAndGradient{.value = f.v[1], .gradient = Vec3{f.d[0][1], f.d[1][1], f.d[2][1]}}};
}

SegmentRange evaluate_along(const FormulaView& formula, const Vec3& from, const Vec3& segment,
                            const Interval& t) {
  const auto f =
      run<AlongSegment>(formula.instructions, {coordinate_along(from.x(), segment.x(), t),
                                               coordinate_along(from.y(), segment.y(), t),
                                               coordinate_along(from.z(), segment.z(), t)});
  return {.value = f.v, .slope = f.d[0]};
}

Interval evaluate_box(const FormulaView& formula, const Vec3& lower, const Vec3& upper) {
  return run<Interval>(formula.instructions,
                       {{lower.x(), upper.x()}, {lower.y(), upper.y()}, {lower.z(), upper.z()}});
}

}  // namespace tactus::rendering
