// Baking tells what is odd about a formula that can be touched.
#include "host_tools/bake/formula/formula_warnings.h"

#include <gtest/gtest.h>

#include "host_tools/bake/formula/formula_parser.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::Sides;
using testing::contains;

const Box kBounds{.lower = Vec3::Constant(-2.0), .upper = Vec3::Constant(2.0)};

std::vector<std::string> warned_of_formula(std::string_view text, Sides sides = Sides::one) {
  return formula_warnings(parse_formula(text).view(), kBounds, sides);
}

TEST(FormulaWarnings, ThereAreNoneForAnOrdinaryShape) {
  for (const char* text : {"sphere(1)", "heart()", "torus(1, 0.3)", "z", "x^2 + y^2 - sqrt(z^2)",
                           "intersection(barth_sextic(), sphere(1.7))"}) {
    EXPECT_TRUE(warned_of_formula(text).empty()) << text << ": " << warned_of_formula(text).front();
  }
}

TEST(FormulaWarnings, AFunctionOutsideItsDomainIsToldOnceWithThePlace) {
  const auto root = warned_of_formula("sqrt(x) + sqrt(x - 1) - 0.5");
  ASSERT_EQ(root.size(), 1U);
  EXPECT_TRUE(contains(root.front(), "at (-2, -2, -2) the formula takes sqrt of a number below 0"));
  EXPECT_TRUE(contains(warned_of_formula("log(y) + x").front(), "counts as -708"));
  EXPECT_TRUE(
      contains(warned_of_formula("sin(1000000*x) + z").front(), "more than a million radians"));
}

TEST(FormulaWarnings, SwappedSidesAreToldWithTheRemedy) {
  const auto swapped = warned_of_formula("1 - x^2 - y^2 - z^2");
  ASSERT_EQ(swapped.size(), 1U);
  EXPECT_TRUE(contains(swapped.front(), "write -(...) around the formula"));
  EXPECT_TRUE(warned_of_formula("1 - x^2 - y^2 - z^2", Sides::two).empty());
}

TEST(FormulaWarnings, AFormulaWithoutASurfaceIsToldWhyItHasNone) {
  const auto why = [](std::string_view text) {
    const Formula formula = parse_formula(text);
    return why_nowhere_zero(search_zero(formula.view(), kBounds, 1.0), kBounds, 1.0);
  };
  EXPECT_TRUE(contains(why("x^2"), "touches 0 at (0, -2, -2) and never changes its sign"));
  EXPECT_TRUE(contains(why("x^2 + y^2 + 3"), "above 0 everywhere"));
  EXPECT_TRUE(contains(why("x^2 + y^2 + 3"), "at (0, 0, -2) with 3"));
  EXPECT_TRUE(contains(why("-1 - z^2"), "below 0 everywhere"));
}

}  // namespace
}  // namespace tactus::host
