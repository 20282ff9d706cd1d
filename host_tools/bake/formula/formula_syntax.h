// Reads the text of a formula into a syntax tree. formula_parser.cpp turns the tree into
// instructions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// A node of the tree.
struct FormulaNode {
  enum class Kind { number, name, call, negate, add, subtract, multiply, divide, power };

  Kind kind = Kind::number;
  double number = 0.0;
  // The name of a variable, constant or function.
  std::string name;
  // The node's place in the text, in characters from 0.
  std::size_t place = 0;
  // The operands of an operator, or the arguments of a call.
  std::vector<FormulaNode> children;
};

// Returns the tree of a text. Throws InputError as parse_formula() does.
FormulaNode read_formula_syntax(std::string_view text);

// Throws the error of a place in the text: "formula, column 3: what (at >>> in: ...)".
[[noreturn]] void fail_formula(std::string_view text, std::size_t place, std::string_view what);

}  // namespace tactus::host
