// The functions and ready shapes that a formula may name.
#pragma once

#include <cstddef>
#include <expected>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/bake/formula/formula_builder.h"

namespace tactus::host {

// The coordinates at which a function is evaluated. Inside translate() and similar functions they
// are the moved ones.
struct FormulaCoordinates {
  FormulaBuilder::Value x = 0;
  FormulaBuilder::Value y = 0;
  FormulaBuilder::Value z = 0;
};

struct FormulaFunction {
  using Value = FormulaBuilder::Value;
  // The error says what is wrong with an argument, and the remedy.
  using Result = std::expected<Value, std::string>;
  using Apply = Result (*)(FormulaBuilder&, const FormulaCoordinates&, std::span<const Value>);

  std::string_view name;
  std::string_view arguments;  // as the user writes them: "r" of sphere(r)
  std::size_t fewest = 0;
  std::size_t most = 0;
  Apply apply = nullptr;
};

// Sorted by theme, as the user's page lists them.
std::span<const FormulaFunction> formula_functions();

}  // namespace tactus::host
