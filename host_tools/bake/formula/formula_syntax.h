// A formula's text as a tree.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

struct FormulaNode {
  enum class Kind { number, name, call, negate, add, subtract, multiply, divide, power };

  Kind kind = Kind::number;
  double number = 0.0;
  std::string name;                   // of a name or a call
  std::size_t place = 0;              // in the text, from 0
  std::vector<FormulaNode> children;  // operands, or a call's arguments
};

// Throws InputError as parse_formula() does.
FormulaNode read_formula_syntax(std::string_view text);

// The error that parse_formula() throws: "column 3: what (where)".
[[noreturn]] void fail_formula(std::string_view text, std::size_t place, std::string_view what);

}  // namespace tactus::host
