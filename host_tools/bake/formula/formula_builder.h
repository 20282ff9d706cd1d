// Builds the list of instructions of a formula. The compiler of formula_parser.cpp drives it while
// baking; the controller only evaluates the finished list.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "rendering/surface/formula.h"

namespace tactus::host {

// Collects instructions. Operations on constants are computed at once, equal subexpressions get one
// instruction, and neutral operations such as a * 1 disappear.
class FormulaBuilder {
 public:
  // The number of an intermediate result. A function below that takes values returns the result's
  // number.
  using Value = std::uint32_t;

  // Returns a number as a value.
  Value constant(double c);
  // The three coordinates of the point at which the formula is evaluated.
  Value x() { return put({.opcode = rendering::Opcode::x}); }
  Value y() { return put({.opcode = rendering::Opcode::y}); }
  Value z() { return put({.opcode = rendering::Opcode::z}); }

  // The operations of arithmetic: a + b, a - b, a * b, a / b and -a.
  Value add(Value a, Value b);
  Value subtract(Value a, Value b);
  Value multiply(Value a, Value b);
  Value divide(Value a, Value b);
  Value negate(Value a);
  // Returns a^n for a whole number 1 <= n <= kMaxExponent.
  Value whole_power(Value a, int n);
  // Returns a^n for any whole number n; nothing if |n| is above kMaxExponent.
  std::optional<Value> power(Value a, int n);
  // Returns a^exponent for a constant exponent that need not be whole.
  Value real_power(Value a, double exponent);
  // Returns (|a|^p + |b|^p)^(1/p), in the form of rendering::Opcode::power_norm. |p| must be at
  // least 1.
  Value power_norm(Value a, Value b, double p);
  // Return the smaller and the larger of two values.
  Value minimum(Value a, Value b);
  Value maximum(Value a, Value b);
  // A function of one operand: square_root, sine, cosine, exponential, logarithm or magnitude.
  Value function(rendering::Opcode opcode, Value a);

  // Returns the number if the value is constant. It is not finite after a division by zero or an
  // overflow.
  [[nodiscard]] std::optional<double> known(Value a) const;

  // Returns the instructions that compute `result`, in order and renumbered, without those that it
  // does not need. The list may be longer than the format allows; the caller checks.
  [[nodiscard]] std::vector<rendering::Instruction> list(Value result) const;

 private:
  // The identity of an instruction: two are equal if all parts are, the constant by its bits.
  using Key = std::tuple<rendering::Opcode, Value, Value, std::int16_t, std::uint64_t>;

  // An instruction whose operands may have larger numbers than the format can store.
  struct Entry {
    rendering::Opcode opcode = rendering::Opcode::constant;
    Value a = 0;
    Value b = 0;
    std::int16_t exponent = 0;
    double constant = 0.0;
  };

  // Returns the number of the entry: that of an equal one if there is one.
  Value put(const Entry& entry);
  // Return a + c and c * a, as one instruction each.
  Value add_constant(Value a, double c);
  Value scale(Value a, double c);
  // Returns the result of an operation on constants; nothing if an operand is not constant.
  [[nodiscard]] std::optional<double> fold(const Entry& entry) const;

  std::vector<Entry> entries_;
  std::map<Key, Value> known_entries_;
};

}  // namespace tactus::host
