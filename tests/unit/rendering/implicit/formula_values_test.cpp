// Formulas from text against the reference values (tests/reference/README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "host_tools/bake/formula/formula_parser.h"
#include "tests/support/csv.h"

namespace tactus::rendering {
namespace {

using host::Formula;
using host::parse_formula;
using testing::Csv;

const std::map<std::string, std::string>& texts() {
  static const std::map<std::string, std::string> all{
      {"heart", "(x^2+9/4*y^2+z^2-1)^3 - x^2*z^3 - 9/80*y^2*z^3"},
      {"torus_R1_r0.4", "(x^2+y^2+z^2 + 1^2 - 0.4^2)^2 - 4*1^2*(x^2+y^2)"},
      {"barth_w1",
       "4*(((1+sqrt(5))/2)^2*x^2-y^2)*(((1+sqrt(5))/2)^2*y^2-z^2)*(((1+sqrt(5))/2)^2*z^2-x^2)"
       " - (2+sqrt(5))*(x^2+y^2+z^2-1)^2"},
      {"klein", "(x^2+y^2+z^2+2*y-1)*((x^2+y^2+z^2-2*y-1)^2-8*z^2) + 16*x*z*(x^2+y^2+z^2-2*y-1)"},
      {"gyroid", "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)"}};
  return all;
}

// Ready shapes whose function is that of the reference.
const std::map<std::string, std::string>& ready() {
  static const std::map<std::string, std::string> all{{"heart", "heart()"},
                                                      {"barth_w1", "barth_sextic()"},
                                                      {"klein", "klein_bottle()"},
                                                      {"gyroid", "gyroid()"}};
  return all;
}

void expect_reference(const std::string& text, const Csv& csv, std::size_t row) {
  const Formula formula = parse_formula(text);
  const Vec3 p = csv.vector(row, "");
  const Vec3 gradient = csv.vector(row, "f");
  const ValueAndGradient f = evaluate_gradient(formula.view(), p);
  const double size = std::max({1.0, std::abs(csv.number(row, "f")), gradient.norm()});
  EXPECT_NEAR(f.value, csv.number(row, "f"), 1e-12 * size) << text << " row " << row;
  EXPECT_LE((f.gradient - gradient).norm(), 1e-12 * size) << text << " row " << row;
}

TEST(FormulaValues, AreThoseOfTheReferenceWithExactGradients) {
  const Csv csv("implicit_values.csv");
  ASSERT_EQ(csv.rows(), 200U);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    expect_reference(texts().at(csv.text(row, "surface")), csv, row);
  }
}

TEST(FormulaValues, OfTheReadyShapesAreThoseOfTheReference) {
  const Csv csv("implicit_values.csv");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    if (const auto text = ready().find(csv.text(row, "surface")); text != ready().end()) {
      expect_reference(text->second, csv, row);
    }
  }
}

TEST(FormulaValues, OfRiccisBlendsAreThoseOfTheReferenceUpToPowersOfAThousand) {
  const Csv csv("ricci_blend_values.csv");
  ASSERT_EQ(csv.rows(), 60U);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const std::string p = csv.text(row, "p");
    // x and y are the two densities.
    const Vec3 d{csv.number(row, "d1"), csv.number(row, "d2"), 0.0};
    const double blended = evaluate(parse_formula("ricci(x, y, " + p + ")").view(), d);
    const double cut = evaluate(parse_formula("ricci(x, y, -" + p + ")").view(), d);
    EXPECT_NEAR(blended, csv.number(row, "union"), 2e-11 * blended);
    EXPECT_NEAR(cut, csv.number(row, "intersection"), 2e-11 * cut);
  }
}

TEST(FormulaValues, OfABlendKeepRiccisSurface) {
  // Two spheres as Ricci has them: density r^2 / |p - c|^2, 1 on the surface.
  const Formula blend = parse_formula("blend_union(x^2+y^2+z^2 - 1, (x-1.5)^2+y^2+z^2 - 1, 3)");
  const auto density = [](const Vec3& p) {
    const double a = 1.0 / p.squaredNorm();
    const double b = 1.0 / (p - Vec3{1.5, 0.0, 0.0}).squaredNorm();
    return std::cbrt(a * a * a + b * b * b);
  };
  for (int i = 0; i <= 100; ++i) {
    const Vec3 p{-1.5 + 0.045 * i, 0.9, 0.3};
    EXPECT_NEAR(evaluate(blend.view(), p), 1.0 / density(p) - 1.0, 1e-13);
  }
}

TEST(FormulaValues, OfGradientsAgreeWithDifferencesForEveryFunction) {
  const Vec3 p{0.37, 0.61, -0.23};
  constexpr double kStep = 1e-6;
  for (const char* text : {"sqrt(x+y)",
                           "sin(x*z)",
                           "cos(y-z)",
                           "tan(x)",
                           "exp(x*y)",
                           "log(x+y)",
                           "abs(z)*y",
                           "length(x,y)",
                           "length(x,y,z)",
                           "min(x,y)+z",
                           "max(x,y,z)",
                           "x^2.5*y",
                           "x^y",
                           "x^-3",
                           "ricci(x,y,4)*z",
                           "ricci(x,y,-2.5)",
                           "x/(y+z)",
                           "blend_union(sphere(1),box(1,1,1),4)",
                           "blend_intersection(sphere(1),torus(1,.3),2,0.5)",
                           "blend_difference(sphere(1),x,3)",
                           "cone(1,2)",
                           "capsule(.2,.1)",
                           "cylinder(.3,2)",
                           "plane(1,2,3,0.1)",
                           "shell(sphere(1),.1)",
                           "rotate(box(1,.2,.3),1,2,3,40)",
                           "scale(heart(),0.3)",
                           "translate(torus(1,.2),.1,.2,.3)",
                           "quartic()"}) {
    const Formula formula = parse_formula(text);
    const ValueAndGradient f = evaluate_gradient(formula.view(), p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = kStep * Vec3::Unit(axis);
      const double difference =
          (evaluate(formula.view(), p + step) - evaluate(formula.view(), p - step)) / (2.0 * kStep);
      EXPECT_NEAR(f.gradient[axis], difference, 1e-8 * std::max(1.0, std::abs(difference)))
          << text << " axis " << axis;
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
