#include "host_tools/bake/formula/formula_parser.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "hal/angle.h"
#include "host_tools/bake/formula/formula_builder.h"
#include "host_tools/bake/formula/formula_functions.h"
#include "host_tools/bake/formula/formula_syntax.h"
#include "host_tools/nearest_name.h"
#include "rendering/geometry/portable_math.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

using Kind = FormulaNode::Kind;
using Value = FormulaBuilder::Value;

// A function that moves its first argument by changing the coordinates; its other arguments are
// numbers.
struct Placing {
  std::string_view name;
  std::string_view arguments;
  std::size_t count;
};
// Their names, their arguments as the messages show them, and how many they have.
constexpr std::array kPlacings{
    Placing{"translate", "a, x, y, z", 4},
    Placing{"rotate", "a, axis_x, axis_y, axis_z, angle_deg", 5},
    Placing{"scale", "a, s", 2},
};

// Walks the syntax tree and builds instructions. It throws InputError at the place of the error.
class Compiler {
 public:
  explicit Compiler(std::string_view text) : text_(text) {}

  // Returns the instructions. Throws InputError also for a formula that is constant, too long or
  // not finite.
  Formula compile() {
    const FormulaNode root = read_formula_syntax(text_);
    const FormulaCoordinates world{.x = builder_.x(), .y = builder_.y(), .z = builder_.z()};
    const Value result = value_of(root, world);
    if (builder_.known(result)) {
      fail_formula(text_, 0, "it is the same everywhere; let it depend on x, y or z");
    }
    Formula formula{.instructions = builder_.list(result)};
    const std::size_t size = formula.instructions.size();
    if (size > rendering::kMaxFormulaInstructions) {
      fail_formula(text_, 0,
                   fmt::format("it needs {} instructions, where {} fit; simplify it, or spread it "
                               "over several objects",
                               size, rendering::kMaxFormulaInstructions));
    }
    if (!rendering::check(formula.view())) {
      fail_formula(text_, 0, "a number in it is not finite; look for overflows");
    }
    return formula;
  }

 private:
  // Returns the value of a node. Throws InputError if it is a constant that is not finite.
  Value value_of(const FormulaNode& node, const FormulaCoordinates& at) {
    const Value value = any_value_of(node, at);
    if (const auto known = builder_.known(value); known && !std::isfinite(*known)) {
      fail_formula(text_, node.place,
                   "this is not a finite number; look for a division by 0 or an overflow");
    }
    return value;
  }

  // Returns the value of a node, which may be a constant that is not finite.
  Value any_value_of(const FormulaNode& node, const FormulaCoordinates& at) {
    const auto operand = [&](std::size_t i) { return value_of(node.children[i], at); };
    switch (node.kind) {
      case Kind::number:
        return builder_.constant(node.number);
      case Kind::name:
        return name(node, at);
      case Kind::call:
        return call(node, at);
      case Kind::negate:
        return builder_.negate(operand(0));
      case Kind::power:
        return power(node, at);
      default:
        break;
    }
    const Value a = operand(0);
    const Value b = operand(1);
    switch (node.kind) {
      case Kind::add:
        return builder_.add(a, b);
      case Kind::subtract:
        return builder_.subtract(a, b);
      case Kind::multiply:
        return builder_.multiply(a, b);
      default:
        return builder_.divide(a, b);
    }
  }

  // Returns a coordinate or pi. Throws InputError for any other name.
  Value name(const FormulaNode& node, const FormulaCoordinates& at) {
    if (node.name == "x") {
      return at.x;
    }
    if (node.name == "y") {
      return at.y;
    }
    if (node.name == "z") {
      return at.z;
    }
    if (node.name == "pi") {
      return builder_.constant(std::numbers::pi);
    }
    fail_unknown(node);
  }

  // Returns base^exponent: by multiplications for a whole exponent, by real_power() for another
  // constant one.
  Value power(const FormulaNode& node, const FormulaCoordinates& at) {
    const Value base = value_of(node.children[0], at);
    const Value exponent = value_of(node.children[1], at);
    const std::optional<double> known = builder_.known(exponent);
    // An exponent that varies: a^b = exp(b log a), which needs a positive base.
    if (!known) {
      return builder_.function(
          rendering::Opcode::exponential,
          builder_.multiply(exponent, builder_.function(rendering::Opcode::logarithm, base)));
    }
    if (*known != std::floor(*known)) {
      return builder_.real_power(base, *known);
    }
    const auto result = std::abs(*known) <= rendering::kMaxExponent
                            ? builder_.power(base, static_cast<int>(*known))
                            : std::nullopt;
    if (!result) {
      fail_formula(text_, node.children[1].place,
                   fmt::format("an exponent of {}, where {} is the largest; split the power",
                               *known, rendering::kMaxExponent));
    }
    return *result;
  }

  // Returns the value of a function, or of a shape that a placing moves.
  Value call(const FormulaNode& node, const FormulaCoordinates& at) {
    const auto placing = std::ranges::find(kPlacings, node.name, &Placing::name);
    if (placing != kPlacings.end()) {
      require_arguments(node, placing->arguments, placing->count, placing->count);
      const Value moved = value_of(node.children[0], placed(node, at));
      // A shape that is scaled by s has s times the distance, so that a distance stays a distance.
      return node.name == "scale" ? builder_.multiply(builder_.constant(number(node, 1)), moved)
                                  : moved;
    }
    const auto functions = formula_functions();
    const auto function = std::ranges::find(functions, node.name, &FormulaFunction::name);
    if (function == functions.end()) {
      fail_unknown(node);
    }
    require_arguments(node, function->arguments, function->fewest, function->most);
    std::vector<Value> arguments;
    arguments.reserve(node.children.size());
    for (const FormulaNode& child : node.children) {
      arguments.push_back(value_of(child, at));
    }
    const auto result = function->apply(builder_, at, arguments);
    if (!result) {
      fail_formula(text_, node.place,
                   fmt::format("{}({}): {}", node.name, function->arguments, result.error()));
    }
    return *result;
  }

  // Returns the coordinates inside a placing: a shape moves one way, its coordinates the other.
  FormulaCoordinates placed(const FormulaNode& node, const FormulaCoordinates& at) {
    if (node.name == "translate") {
      return {.x = builder_.add(at.x, builder_.constant(-number(node, 1))),
              .y = builder_.add(at.y, builder_.constant(-number(node, 2))),
              .z = builder_.add(at.z, builder_.constant(-number(node, 3)))};
    }
    if (node.name == "rotate") {
      return turned(node, at);
    }
    const double inverse = 1.0 / number(node, 1);
    return {.x = builder_.multiply(builder_.constant(inverse), at.x),
            .y = builder_.multiply(builder_.constant(inverse), at.y),
            .z = builder_.multiply(builder_.constant(inverse), at.z)};
  }

  // The shape turns by the right hand about the axis, so its coordinates turn back.
  FormulaCoordinates turned(const FormulaNode& node, const FormulaCoordinates& at) {
    const Vec3 axis{number(node, 1), number(node, 2), number(node, 3)};
    if (!(axis.norm() > 0.0)) {
      fail_formula(text_, node.place, "rotate: the axis is zero; write rotate(a, 0, 0, 1, 90)");
    }
    const double half_rad = 0.5 * hal::radians_of(number(node, 4));
    const auto [sine, cosine] = rendering::sine_cosine(half_rad);
    if (std::isnan(sine)) {
      fail_formula(text_, node.children[4].place, "rotate: this angle is beyond all turns");
    }
    const Vec3 v = sine * axis.normalized();
    const Mat3 back =
        Eigen::Quaterniond(cosine, v.x(), v.y(), v.z()).toRotationMatrix().transpose();
    const auto row = [&](int i) {
      const auto part = [&](int j, Value coordinate) {
        // A quarter turn leaves rounding errors where zeros belong; they would cost instructions.
        constexpr double kNone = 1e-15;
        const double c = std::abs(back(i, j)) < kNone ? 0.0 : back(i, j);
        return builder_.multiply(builder_.constant(c), coordinate);
      };
      return builder_.add(builder_.add(part(0, at.x), part(1, at.y)), part(2, at.z));
    };
    return {.x = row(0), .y = row(1), .z = row(2)};
  }

  // Returns the number that an argument of a placing must be.
  double number(const FormulaNode& node, std::size_t i) {
    const FormulaNode& child = node.children[i];
    const auto known =
        builder_.known(value_of(child, {.x = builder_.x(), .y = builder_.y(), .z = builder_.z()}));
    if (!known) {
      fail_formula(text_, child.place,
                   fmt::format("{} needs a number here, not something that depends on x, y or z",
                               node.name));
    }
    if (node.name == "scale" && !(*known > 0.0)) {
      fail_formula(text_, child.place, "scale needs a number above 0; turn with rotate");
    }
    return *known;
  }

  // Throws InputError with the arguments if their number is wrong.
  void require_arguments(const FormulaNode& node, std::string_view arguments, std::size_t fewest,
                         std::size_t most) {
    const std::size_t count = node.children.size();
    if (count < fewest || count > most) {
      fail_formula(
          text_, node.place,
          fmt::format("{} arguments for {}; write {}({})", count, node.name, node.name, arguments));
    }
  }

  // Reports an unknown name with the nearest known one.
  [[noreturn]] void fail_unknown(const FormulaNode& node) {
    NearestName nearest(node.name);
    nearest.consider("pi");
    for (const FormulaFunction& function : formula_functions()) {
      nearest.consider(function.name);
      if (function.name == node.name) {
        fail_formula(text_, node.place,
                     fmt::format("{} is a function; write {}({})", node.name, node.name,
                                 function.arguments));
      }
    }
    for (const Placing& placing : kPlacings) {
      nearest.consider(placing.name);
    }
    const auto meant = nearest.found();
    fail_formula(text_, node.place,
                 fmt::format("no name '{}'; {}", node.name,
                             meant ? fmt::format("did you mean {}?", *meant)
                                   : "there are x, y, z, pi and the functions of "
                                     "rendering/surface/README.md"));
  }

  std::string_view text_;
  FormulaBuilder builder_;
};

}  // namespace

Formula parse_formula(std::string_view text) {
  return Compiler(text).compile();
}

}  // namespace tactus::host
