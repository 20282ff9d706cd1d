// Puts a formula's instructions together: constants are folded, equal subexpressions are computed
// once, and neutral operations fall away.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "rendering/surface/formula.h"

namespace tactus::host {

class FormulaBuilder {
 public:
  // The number of an intermediate result.
  using Value = std::uint32_t;

  Value constant(double c);
  Value x() { return put({.opcode = rendering::Opcode::x}); }
  Value y() { return put({.opcode = rendering::Opcode::y}); }
  Value z() { return put({.opcode = rendering::Opcode::z}); }

  Value add(Value a, Value b);
  Value subtract(Value a, Value b);
  Value multiply(Value a, Value b);
  Value divide(Value a, Value b);
  Value negate(Value a);
  // a^n for 1 <= n <= kMaxExponent.
  Value whole_power(Value a, int n);
  // a^n for any integer n; nothing if |n| is above what instructions can hold.
  std::optional<Value> power(Value a, int n);
  Value real_power(Value a, double exponent);
  // |p| >= 1.
  Value power_norm(Value a, Value b, double p);
  Value minimum(Value a, Value b);
  Value maximum(Value a, Value b);
  // Applies a function of one operand: square_root, sine, cosine, exponential, logarithm,
  // magnitude.
  Value function(rendering::Opcode opcode, Value a);

  // The value if it depends on nothing. Not finite after a division by zero or an overflow.
  [[nodiscard]] std::optional<double> known(Value a) const;

  // Returns the instructions that compute `result`, in order and renumbered. The list may be longer
  // than the format allows.
  [[nodiscard]] std::vector<rendering::Instruction> list(Value result) const;

 private:
  using Key = std::tuple<rendering::Opcode, Value, Value, std::int16_t, std::uint64_t>;

  // An instruction whose operands may have larger numbers than the format holds.
  struct Entry {
    rendering::Opcode opcode = rendering::Opcode::constant;
    Value a = 0;
    Value b = 0;
    std::int16_t exponent = 0;
    double constant = 0.0;
  };

  Value put(const Entry& entry);
  Value add_constant(Value a, double c);
  Value scale(Value a, double c);
  [[nodiscard]] std::optional<double> fold(const Entry& entry) const;

  std::vector<Entry> entries_;
  std::map<Key, Value> known_entries_;
};

}  // namespace tactus::host
