#include "host_tools/bake/formula/formula_builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace tactus::host {
namespace {

using rendering::Instruction;
using rendering::Opcode;

// Returns true for instructions without operands.
bool is_leaf(Opcode opcode) {
  return opcode == Opcode::constant || opcode == Opcode::x || opcode == Opcode::y ||
         opcode == Opcode::z;
}

// Returns true for instructions with two operands; all others have one or none.
bool is_binary(Opcode opcode) {
  switch (opcode) {
    case Opcode::add:
    case Opcode::subtract:
    case Opcode::multiply:
    case Opcode::divide:
    case Opcode::minimum:
    case Opcode::maximum:
    case Opcode::power_norm:
      return true;
    default:
      return false;
  }
}

}  // namespace

FormulaBuilder::Value FormulaBuilder::constant(double c) {
  // Adding 0.0 turns -0 into 0, so that there is one zero.
  return put({.opcode = Opcode::constant, .constant = c + 0.0});
}

FormulaBuilder::Value FormulaBuilder::put(const Entry& entry) {
  if (const std::optional<double> value = fold(entry)) {
    return constant(*value);
  }
  const Key key{entry.opcode, entry.a, entry.b, entry.exponent,
                std::bit_cast<std::uint64_t>(entry.constant)};
  const auto [place, is_new] = known_entries_.try_emplace(key, static_cast<Value>(entries_.size()));
  if (is_new) {
    entries_.push_back(entry);
  }
  return place->second;
}

// The controller's own arithmetic computes the value, so folding changes no bit of the result.
std::optional<double> FormulaBuilder::fold(const Entry& entry) const {
  if (is_leaf(entry.opcode)) {
    return std::nullopt;
  }
  const std::optional<double> a = known(entry.a);
  const std::optional<double> b = is_binary(entry.opcode) ? known(entry.b) : std::optional(0.0);
  if (!a || !b) {
    return std::nullopt;
  }
  const std::array<Instruction, 3> list{
      Instruction{.constant = *a}, Instruction{.constant = *b},
      Instruction{.opcode = entry.opcode,
                  .a = 0,
                  .b = static_cast<std::uint16_t>(is_binary(entry.opcode) ? 1 : 0),
                  .exponent = entry.exponent,
                  .constant = entry.constant}};
  return rendering::evaluate({list}, Vec3::Zero());
}

std::optional<double> FormulaBuilder::known(Value a) const {
  const Entry& entry = entries_[a];
  return entry.opcode == Opcode::constant ? std::optional(entry.constant) : std::nullopt;
}

// Adjacent sums with constants become one.
FormulaBuilder::Value FormulaBuilder::add_constant(Value a, double c) {
  if (c == 0.0) {
    return a;
  }
  const Entry entry = entries_[a];
  return entry.opcode == Opcode::offset ? add_constant(entry.a, entry.constant + c)
                                        : put({.opcode = Opcode::offset, .a = a, .constant = c});
}

// Adjacent products with constants become one, with the sign in the constant.
FormulaBuilder::Value FormulaBuilder::scale(Value a, double c) {
  const Entry entry = entries_[a];
  if (c == 0.0) {
    return constant(0.0);
  }
  if (c == 1.0) {
    return a;
  }
  if (c == -1.0) {
    return put({.opcode = Opcode::negate, .a = a});
  }
  if (entry.opcode == Opcode::scale) {
    return scale(entry.a, entry.constant * c);
  }
  return entry.opcode == Opcode::negate ? scale(entry.a, -c)
                                        : put({.opcode = Opcode::scale, .a = a, .constant = c});
}

FormulaBuilder::Value FormulaBuilder::add(Value a, Value b) {
  if (const auto c = known(a)) {
    return add_constant(b, *c);
  }
  if (const auto c = known(b)) {
    return add_constant(a, *c);
  }
  if (entries_[b].opcode == Opcode::negate) {
    return subtract(a, entries_[b].a);
  }
  // Sums do not depend on the order; ordered operands let a + b and b + a share an instruction.
  return put({.opcode = Opcode::add, .a = std::min(a, b), .b = std::max(a, b)});
}

FormulaBuilder::Value FormulaBuilder::subtract(Value a, Value b) {
  if (const auto c = known(b)) {
    return add_constant(a, -*c);
  }
  if (const auto c = known(a)) {
    return add_constant(negate(b), *c);
  }
  return a == b ? constant(0.0) : put({.opcode = Opcode::subtract, .a = a, .b = b});
}

FormulaBuilder::Value FormulaBuilder::multiply(Value a, Value b) {
  if (const auto c = known(a)) {
    return scale(b, *c);
  }
  if (const auto c = known(b)) {
    return scale(a, *c);
  }
  return a == b ? put({.opcode = Opcode::power, .a = a, .exponent = 2})
                : put({.opcode = Opcode::multiply, .a = std::min(a, b), .b = std::max(a, b)});
}

FormulaBuilder::Value FormulaBuilder::divide(Value a, Value b) {
  if (const auto c = known(b); c && !known(a)) {
    const double inverse = 1.0 / *c;
    return *c == 0.0 ? constant(inverse) : scale(a, inverse);
  }
  return put({.opcode = Opcode::divide, .a = a, .b = b});
}

FormulaBuilder::Value FormulaBuilder::negate(Value a) {
  const Entry entry = entries_[a];
  if (entry.opcode == Opcode::negate) {
    return entry.a;
  }
  return entry.opcode == Opcode::scale ? scale(entry.a, -entry.constant)
                                       : put({.opcode = Opcode::negate, .a = a});
}

FormulaBuilder::Value FormulaBuilder::whole_power(Value a, int n) {
  if (n == 1) {
    return a;
  }
  // An even power is the square of half the power: that one may exist already, and the interval
  // arithmetic of squares is tighter than that of one high power.
  return n % 2 == 0 && n > 2
             ? put({.opcode = Opcode::power, .a = whole_power(a, n / 2), .exponent = 2})
             : put({.opcode = Opcode::power, .a = a, .exponent = static_cast<std::int16_t>(n)});
}

std::optional<FormulaBuilder::Value> FormulaBuilder::power(Value a, int n) {
  const int size = n < 0 ? -n : n;
  if (size > rendering::kMaxExponent) {
    return std::nullopt;
  }
  if (size == 0) {
    return constant(1.0);
  }
  const Value result = whole_power(a, size);
  return n < 0 ? divide(constant(1.0), result) : result;
}

FormulaBuilder::Value FormulaBuilder::real_power(Value a, double exponent) {
  return put({.opcode = Opcode::real_power, .a = a, .constant = exponent});
}

FormulaBuilder::Value FormulaBuilder::power_norm(Value a, Value b, double p) {
  return put(
      {.opcode = Opcode::power_norm, .a = std::min(a, b), .b = std::max(a, b), .constant = p});
}

FormulaBuilder::Value FormulaBuilder::minimum(Value a, Value b) {
  return a == b ? a : put({.opcode = Opcode::minimum, .a = a, .b = b});
}

FormulaBuilder::Value FormulaBuilder::maximum(Value a, Value b) {
  return a == b ? a : put({.opcode = Opcode::maximum, .a = a, .b = b});
}

FormulaBuilder::Value FormulaBuilder::function(Opcode opcode, Value a) {
  return put({.opcode = opcode, .a = a});
}

std::vector<Instruction> FormulaBuilder::list(Value result) const {
  // Operands have smaller numbers than their results, so one pass backwards finds all that is
  // needed.
  std::vector<bool> needed(entries_.size());
  needed[result] = true;
  for (Value i = result + 1; i-- > 0;) {
    if (needed[i] && !is_leaf(entries_[i].opcode)) {
      needed[entries_[i].a] = true;
      needed[is_binary(entries_[i].opcode) ? entries_[i].b : entries_[i].a] = true;
    }
  }
  std::vector<Instruction> instructions;
  std::vector<std::uint16_t> number(entries_.size());
  for (Value i = 0; i <= result; ++i) {
    if (!needed[i]) {
      continue;
    }
    const Entry& entry = entries_[i];
    number[i] = static_cast<std::uint16_t>(instructions.size());
    instructions.push_back({.opcode = entry.opcode,
                            .a = is_leaf(entry.opcode) ? std::uint16_t{0} : number[entry.a],
                            .b = is_binary(entry.opcode) ? number[entry.b] : std::uint16_t{0},
                            .exponent = entry.exponent,
                            .constant = entry.constant});
  }
  return instructions;
}

}  // namespace tactus::host
