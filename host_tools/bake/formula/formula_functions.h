// The functions and ready shapes that a formula may name. A new one is a function and a line in the
// table of formula_functions.cpp; rendering/surface/README.md lists them for users.
#pragma once

#include <cstddef>
#include <expected>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/bake/formula/formula_builder.h"

namespace tactus::host {

// The coordinates at which a function is evaluated. Inside translate(), rotate() and scale() they
// are the transformed ones.
struct FormulaCoordinates {
  FormulaBuilder::Value x = 0;
  FormulaBuilder::Value y = 0;
  FormulaBuilder::Value z = 0;
};

// A function by its name, its arguments and what it does.
struct FormulaFunction {
  using Value = FormulaBuilder::Value;
  // The result, or an error text with what is wrong with an argument and the remedy.
  using Result = std::expected<Value, std::string>;
  // Adds the function's instructions to the builder, for arguments that are values already.
  using Apply = Result (*)(FormulaBuilder&, const FormulaCoordinates&, std::span<const Value>);

  std::string_view name;
  // The arguments as messages show them: "r" for sphere(r).
  std::string_view arguments;
  // How many arguments the function takes.
  std::size_t fewest = 0;
  std::size_t most = 0;
  Apply apply = nullptr;
};

// Returns all functions, sorted by theme as in the user's page.
std::span<const FormulaFunction> formula_functions();

}  // namespace tactus::host
