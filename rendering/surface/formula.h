// An implicit surface's formula f(x, y, z) as a short list of instructions, and its evaluation: the
// surface is where f = 0, the inside where f < 0. Baking compiles the list from text
// (host_tools/bake/formula/formula_parser.h); it is plain data and is stored in the scene's image
// as it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/surface/interval.h"

namespace tactus::rendering {

// The operation of an instruction on A and B, the results of the instructions number a and b, with
// its constant c and exponent n. The numbers are part of the image's format. Every operation is
// defined everywhere (see rendering/surface/elementary.h); only poles of `divide` and results
// beyond the range of a double are not finite.
enum class Opcode : std::uint8_t {
  constant = 0,  // c
  x = 1,
  y = 2,
  z = 3,
  add = 4,       // A + B
  subtract = 5,  // A - B
  multiply = 6,  // A * B
  divide = 7,    // A / B
  negate = 8,    // -A
  offset = 9,    // A + c
  scale = 10,    // A * c
  power = 11,    // A^n, 2 <= n <= kMaxExponent
  square_root = 12,
  sine = 13,
  cosine = 14,
  exponential = 15,
  logarithm = 16,
  magnitude = 17,   // |A|
  minimum = 18,     // union
  maximum = 19,     // intersection
  real_power = 20,  // A^c for A > 0
  power_norm = 21,  // (A^c + B^c)^(1/c) for A, B > 0 and |c| >= 1: Ricci's blend
};
inline constexpr std::uint8_t kOpcodes = 22;
inline constexpr std::int16_t kMaxExponent = 64;

// One instruction; its result has its number in the list, and it uses only earlier ones. The last
// result is f.
struct Instruction {
  Opcode opcode = Opcode::constant;
  std::uint8_t unused = 0;
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  std::int16_t exponent = 0;
  double constant = 0.0;

  bool operator==(const Instruction&) const = default;
};
static_assert(sizeof(Instruction) == 16);

struct FormulaView {
  std::span<const Instruction> instructions;
};

enum class FormulaFault : std::uint8_t {
  empty = 0,
  too_long = 1,  // more than kMaxFormulaInstructions
  opcode = 2,    // unknown
  operand = 3,   // refers to itself or a later instruction, or is there without a use
  constant = 4,  // not finite, or |c| < 1 in power_norm
  exponent = 5,  // of `power`, out of its range
};

struct FormulaError {
  FormulaFault fault = FormulaFault::empty;
  std::size_t place = 0;  // the instruction's number
};

// Checks whether the list may be evaluated. The functions below take only lists that pass; with
// others they would read foreign memory.
std::expected<void, FormulaError> check(const FormulaView& formula);

struct ValueAndGradient {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};

// Returns f at p, in the formula's own units. At a kink of f (abs, min, max) the gradient is that
// of one side. Real time; at most kMaxFormulaInstructions steps.
double evaluate(const FormulaView& formula, const Vec3& p);

// Returns the value, with the same bits as `evaluate`, and the gradient.
ValueAndGradient evaluate_gradient(const FormulaView& formula, const Vec3& p);

// Returns the values and the gradients at two points, with the same bits as `evaluate_gradient` at
// each; cheaper than two calls of it.
std::array<ValueAndGradient, 2> evaluate_gradients(const FormulaView& formula, const Vec3& p,
                                                   const Vec3& q);

// Encloses g(t) = f(from + t * segment) and its derivative for all t in `t`, within [0, 1].
struct SegmentRange {
  Interval value;
  Interval slope;
};
SegmentRange evaluate_along(const FormulaView& formula, const Vec3& from, const Vec3& segment,
                            const Interval& t);

// Returns an enclosure of f over the box between two corners.
Interval evaluate_box(const FormulaView& formula, const Vec3& lower, const Vec3& upper);

}  // namespace tactus::rendering
