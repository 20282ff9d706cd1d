// The parser of formulas: their meaning, how short their instructions get, and the messages for
// mistakes.
#include "host_tools/bake/formula/formula_parser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "host_tools/bake/formula/formula_functions.h"
#include "host_tools/input_error.h"
#include "tests/support/share.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Opcode;
using testing::contains;
using testing::input_error;

constexpr std::uint64_t kParserSeed = 20260322;

double value(std::string_view text, const Vec3& p = {0.3, -0.7, 1.1}) {
  return rendering::evaluate(parse_formula(text).view(), p);
}

std::size_t length(std::string_view text) {
  return parse_formula(text).instructions.size();
}

std::string error(const std::string& text) {
  return input_error([&] { parse_formula(text); });
}

TEST(FormulaParser, FollowsTheRulesOfPrecedence) {
  EXPECT_NEAR(value("x + 2*y"), 0.3 - 1.4, 1e-15);
  EXPECT_NEAR(value("-z^2"), -1.21, 1e-15);
  EXPECT_NEAR(value("z^-2"), 1.0 / 1.21, 1e-15);
  EXPECT_NEAR(value("x - y - z"), 0.3 + 0.7 - 1.1, 1e-15);
  EXPECT_NEAR(value("x / y / z"), 0.3 / -0.7 / 1.1, 1e-15);
  EXPECT_NEAR(value("z^2^3"), std::pow(1.1, 8), 1e-14) << "from the right";
  EXPECT_NEAR(value("(x + y) * -z"), 0.44, 1e-15);
  EXPECT_NEAR(value("2 * - + x"), -0.6, 1e-15);
  EXPECT_NEAR(value("x + .5e1 + 2.5E-1"), 5.55, 1e-14);
  EXPECT_NEAR(value("  x\n +\ty "), -0.4, 1e-15);
}

TEST(FormulaParser, KnowsConstantsAndElementaryFunctions) {
  EXPECT_NEAR(value("x + pi"), 0.3 + std::numbers::pi, 1e-15);
  EXPECT_NEAR(value("sin(x) + cos(y) + tan(z)"), std::sin(0.3) + std::cos(-0.7) + std::tan(1.1),
              1e-14);
  EXPECT_NEAR(value("exp(x) + log(z) + sqrt(z) + abs(y)"),
              std::exp(0.3) + std::log(1.1) + std::sqrt(1.1) + 0.7, 1e-14);
  EXPECT_NEAR(value("z^0.5"), std::sqrt(1.1), 1e-15);
  EXPECT_NEAR(value("z^x"), std::pow(1.1, 0.3), 1e-15);
  EXPECT_NEAR(value("min(x, y, z) + 10*max(x, y)"), -0.7 + 3.0, 1e-15);
}

TEST(FormulaParser, MeasuresDistanceInTheReadyShapes) {
  const auto at = [](const char* text, double x, double y, double z) {
    return value(text, {x, y, z});
  };
  EXPECT_NEAR(at("sphere(2)", 3, 0, 4), 3.0, 1e-15);
  EXPECT_NEAR(at("box(2, 4, 6)", 1.5, 0, 0), 0.5, 1e-15);
  EXPECT_NEAR(at("box(2, 4, 6)", 0, 0, 2.5), -0.5, 1e-15);
  EXPECT_NEAR(at("cylinder(1, 4)", 3, 4, 0), 4.0, 1e-15);
  EXPECT_NEAR(at("cylinder(1, 4)", 0, 0, 2.5), 0.5, 1e-15);
  EXPECT_NEAR(at("capsule(1, 4)", 0, 0, 4), 1.0, 1e-15);
  EXPECT_NEAR(at("cone(3, 4)", 3, 0, 0), 0.0, 1e-15);
  EXPECT_NEAR(at("cone(3, 4)", 0, 0, 4), 0.0, 1e-15);
  EXPECT_NEAR(at("cone(3, 4)", 0, 0, 9), 3.0, 1e-15);
  EXPECT_NEAR(at("cone(3, 4)", 0, 0, -1), 1.0, 1e-15);
  EXPECT_NEAR(at("torus(3, 1)", 3, 0, 2), 1.0, 1e-15);
  EXPECT_NEAR(at("plane(0, 2, 0, 0.5)", 9, 1, 9), 0.5, 1e-15);
  EXPECT_NEAR(at("shell(sphere(2), 0.5)", 0, 0, 2.1), -0.15, 1e-15);
}

TEST(FormulaParser, MultipliesCoordinatesThatStandSideBySide) {
  EXPECT_EQ(value("x^2+xy+y^2-1"), value("x^2 + x*y + y^2 - 1"));
  EXPECT_EQ(value("2*xyz^2"), value("2*(x*(y*z^2))"));
  EXPECT_EQ(value("1/xy"), value("1/(x*y)"));
  EXPECT_EQ(value("-xx"), value("-(x*x)"));
  EXPECT_TRUE(testing::contains(error("xa + x"), "no name 'xa'"));
  EXPECT_TRUE(testing::contains(error("x y"), "write * for times"));
}

TEST(FormulaParser, CombinesSolids) {
  const Vec3 in_both{0.5, 0.0, 0.0};
  const Vec3 in_second{1.4, 0.0, 0.0};
  const std::string both = "sphere(1), translate(sphere(1), 1, 0, 0))";
  EXPECT_LT(value("union(" + both, in_second), 0.0);
  EXPECT_GT(value("intersection(" + both, in_second), 0.0);
  EXPECT_LT(value("intersection(" + both, in_both), 0.0);
  EXPECT_GT(value("difference(" + both, in_both), 0.0);
  EXPECT_LT(value("difference(" + both, {-0.5, 0.0, 0.0}), 0.0);
}

TEST(FormulaParser, PlacesShapes) {
  EXPECT_NEAR(value("translate(x, 0.1, 5, 5)"), 0.2, 1e-15);
  EXPECT_NEAR(value("scale(sphere(1), 3)", {4.0, 0.0, 0.0}), 1.0, 1e-15) << "still a distance";
  // A quarter turn about z brings what lies along x to y.
  EXPECT_NEAR(value("rotate(box(4, 1, 1), 0, 0, 2, 90)", {0.0, 1.9, 0.0}), -0.1, 1e-14);
  const Vec3 p{0.3, -0.7, 1.1};
  const Vec3 back = Eigen::AngleAxisd(-0.7, Vec3{1, 2, 3}.normalized()) * p;
  EXPECT_NEAR(value("rotate(heart(), 1, 2, 3, 0.7*180/pi)", p), value("heart()", back), 1e-13);
  // Inner placings come first.
  EXPECT_NEAR(value("translate(scale(x, 2), 1, 0, 0)", {3.0, 0.0, 0.0}), 2.0, 1e-15);
  EXPECT_NEAR(value("scale(translate(x, 1, 0, 0), 2)", {3.0, 0.0, 0.0}), 1.0, 1e-15);
}

TEST(FormulaParser, FoldsConstantsAndComputesEqualPartsOnce) {
  EXPECT_EQ(length("x"), 1U);
  EXPECT_EQ(length("x + 0*y"), 1U);
  EXPECT_EQ(length("1*x/1 - 0"), 1U);
  EXPECT_EQ(length("x*(2*3 + sqrt(16) - 9)"), 1U);
  EXPECT_EQ(length("2*(3*x)"), 2U);
  EXPECT_EQ(length("1 + (x + 2)"), 2U);
  EXPECT_EQ(length("-(-x)"), 1U);
  EXPECT_EQ(length("x*x + x^2"), length("x^2") + 1U);
  EXPECT_EQ(length("sin(x*y) * cos(y*x) "), 6U) << "x*y once";
  EXPECT_EQ(length("(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3"), 17U);
  EXPECT_EQ(parse_formula("x^2/(1/4)").instructions.back().opcode, Opcode::scale);
}

TEST(FormulaParser, FoldsToTheBitsThatTheControllerWouldCompute) {
  const double folded = value("x*0 + sin(0.37)*exp(1.3)/log(7)^1.7 + 0*x + x", {0.0, 0.0, 0.0});
  const double computed = value("sin(x)*exp(y)/log(z)^1.7", {0.37, 1.3, 7.0});
  EXPECT_EQ(folded, computed);
}

TEST(FormulaParser, ShowsTheColumnAndTheRemedyOfAMistake) {
  const auto expect = [](const std::string& text, const std::string& column,
                         const std::string& remedy) {
    const std::string message = error(text);
    EXPECT_TRUE(contains(message, "formula, column " + column + ":")) << message;
    EXPECT_TRUE(contains(message, remedy)) << message;
    EXPECT_FALSE(contains(message, "\n"));
  };
  expect("2x", "2", "write * for times");
  expect("x + sphre(1)", "5", "did you mean sphere?");
  expect("x^2 + y^2 = 1", "11", "compared with 0");
  expect("x + (y - z", "5", "add )");
  expect("x + sphere(1", "11", "add )");
  expect("x + y)", "6", "closes none");
  expect("sphere()", "1", "write sphere(r)");
  expect("box(1, 2)", "1", "write box(a, b, c)");
  expect("heart", "1", "write heart()");
  expect("x *", "4", "too soon");
  expect("", "1", "too soon");
  expect("x**2", "2", "write ^");
  expect("x\xC2\xB2", "2", "write ^2");
  expect("x; y", "2", "not expected");
  expect("1,5*x", "2", "decimals have a point");
  expect("1 + 2", "1", "depend on x, y or z");
  expect("x/0", "2", "division by 0");
  expect("x + log(0)/0", "11", "division by 0");
  expect("x^65", "3", "64");
  expect("x + 1e999", "5", "smaller");
  expect("x + .", "5", "not a number");
  expect("translate(x, y, 0, 0)", "14", "needs a number");
  expect("scale(x, -1)", "10", "above 0");
  expect("rotate(x, 0, 0, 0, 90)", "1", "axis is zero");
  expect("blend_union(x, y, 0.5)", "1", "at least 1");
  expect("blend_union(x, y, z)", "1", "at least 1");
  expect("blend_union(x, y, 2, 0)", "1", "above 0");
  expect("plane(0, 0, 0, 1) + x", "1", "normal is zero");
  expect("fluffy(x)", "1", "README");
  expect(std::string(150, '(') + "x" + std::string(150, ')'), "101", "nested");
  expect(std::string(30'000, ' ') + "x", "20001", "shorten");
}

TEST(FormulaParser, RefusesWhatNeedsTooManyInstructions) {
  std::string text = "x";
  for (int i = 1; i < 300; ++i) {
    text += " + sin(" + std::to_string(i) + "*x)";
  }
  EXPECT_TRUE(contains(error(text), "256 fit"));
}

TEST(FormulaParser, ThrowsNothingButInputErrorsOnRandomText) {
  SCOPED_TRACE(kParserSeed);
  std::mt19937_64 random(kParserSeed);
  std::vector<std::string> words{"x",  "y",          "z",      "+",      "-",     "*", "/",
                                 "^",  "(",          ")",      ",",      " ",     "1", "0",
                                 "2",  "0.5",        "1e9",    "pi",     "1e999", "@", "\xFF",
                                 "\n", "translate(", "scale(", "rotate("};
  for (const FormulaFunction& function : formula_functions()) {
    words.push_back(std::string(function.name) + "(");
  }
  const int runs = testing::share_of(100'000);
  int good = 0;
  for (int run = 0; run < runs; ++run) {
    std::string text;
    const std::size_t size = 1U + random() % 12U;
    for (std::size_t i = 0; i < size; ++i) {
      text += words[random() % words.size()];
    }
    try {
      const Formula formula = parse_formula(text);
      ++good;
      ASSERT_TRUE(rendering::check(formula.view()).has_value()) << text;
      const double f = rendering::evaluate(formula.view(), {0.1, 0.2, 0.3});
      const double g = rendering::evaluate_gradient(formula.view(), {0.1, 0.2, 0.3}).value;
      ASSERT_TRUE(f == g || (std::isnan(f) && std::isnan(g))) << text;
    } catch (const InputError& error) {
      ASSERT_TRUE(contains(error.what(), "formula, column ")) << text;
    }
  }
  EXPECT_GT(good, runs / 400);
}

}  // namespace
}  // namespace tactus::host
