// The field that is drawn is that of the formula's text, where the view is in the world.
#include "host_tools/plot/field_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host_tools/bake/formula/formula_parser.h"

namespace tactus::host {
namespace {

// Views along the world's x and y, from a surface point at `origin_W`.
TickSteps level_tick(const Vec3& origin_W) {
  TickSteps tick;
  tick.tool_W = origin_W + Vec3(0.002, -0.001, 0.0);
  tick.proxy_W = origin_W;
  tick.from_W = origin_W;
  tick.surface_W = origin_W;
  tick.normal_W = Vec3::UnitY();
  return tick;
}

Window window_of(double half_mm) {
  return {.lower = {.right = -half_mm, .up = -half_mm},
          .upper = {.right = half_mm, .up = half_mm},
          .empty = false};
}

constexpr double kFieldTilt = 0.6;

// A surface that is turned about z, moved and scaled.
rendering::ImplicitSurface placed(const Formula& formula) {
  rendering::ImplicitSurface surface{.formula = formula.view()};
  surface.bounds_O = {.lower = Vec3::Constant(-1.5), .upper = Vec3::Constant(1.5)};
  surface.R_WO << std::cos(kFieldTilt), -std::sin(kFieldTilt), 0.0, std::sin(kFieldTilt),
      std::cos(kFieldTilt), 0.0, 0.0, 0.0, 1.0;
  surface.p_WO = {0.01, -0.02, 0.005};
  surface.scale_m = 0.03;
  return surface;
}

TEST(FieldGrid, HasTheFormulasValuesWhereTheViewIs) {
  const Formula formula = parse_formula("(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3");
  const Vec3 origin_W(0.02, 0.01, 0.012);
  const TickSteps tick = level_tick(origin_W);
  const FieldGrid grid =
      sample_field(placed(formula), TickView({&tick, 1}, false), window_of(12.0), 31);
  int compared = 0;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double pixel_mm = 24.0 / 31.0;
      const double dx =
          0.02 + 1e-3 * (-12.0 + (static_cast<double>(column) + 0.5) * pixel_mm) - 0.01;
      const double dy = 0.01 + 1e-3 * (-12.0 + (static_cast<double>(row) + 0.5) * pixel_mm) + 0.02;
      const double x = (std::cos(kFieldTilt) * dx + std::sin(kFieldTilt) * dy) / 0.03;
      const double y = (-std::sin(kFieldTilt) * dx + std::cos(kFieldTilt) * dy) / 0.03;
      const double z = (0.012 - 0.005) / 0.03;
      const double got = grid.at(column, row);
      if (std::max(std::abs(x), std::abs(y)) > 1.5 + 1e-9) {
        EXPECT_TRUE(std::isnan(got)) << x << " " << y;
      } else if (std::max(std::abs(x), std::abs(y)) < 1.5 - 1e-9) {
        const double a = x * x + 2.25 * y * y + z * z - 1.0;
        const double expected = a * a * a - x * x * z * z * z - 0.1125 * y * y * z * z * z;
        EXPECT_NEAR(got, expected, 1e-9 * (1.0 + std::abs(expected)));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(FieldGrid, TheZeroLineOfASphereIsTheCircleInWhichThePlaneCutsIt) {
  const Formula formula = parse_formula("x^2 + y^2 + z^2 - 1");
  // The plane is 18 mm from the centre of a sphere of 30 mm: the circle has 24 mm.
  const TickSteps tick = level_tick({0.01, -0.02, 0.005 + 0.018});
  const FieldGrid grid =
      sample_field(placed(formula), TickView({&tick, 1}, false), window_of(30.0), 120);
  const auto pieces = contour_of(grid, 0.0);
  ASSERT_GT(pieces.size(), 200U);
  double length = 0.0;
  for (const auto& [a, b] : pieces) {
    EXPECT_NEAR(std::hypot(a.right, a.up), 24.0, 0.01);
    length += std::hypot(a.right - b.right, a.up - b.up);
  }
  EXPECT_NEAR(length, 2.0 * std::acos(-1.0) * 24.0, 0.1);
}

TEST(FieldGrid, TheHeightOfAPlaneIsTheDistanceInTheWorld) {
  // A steep formula: its value is not its distance.
  const Formula formula = parse_formula("7*(y - 0.2)");
  rendering::ImplicitSurface surface = placed(formula);
  surface.R_WO = Mat3::Identity();
  const TickSteps tick = level_tick({0.01, -0.02 + 0.2 * 0.03, 0.005});
  const FieldGrid grid = sample_height(surface, TickView({&tick, 1}, false), window_of(2.0), 20);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    EXPECT_NEAR(grid.at(7, row), 1e-3 * grid.middle(7, row).up, 1e-12);
  }
}

TEST(FieldGrid, AFieldWithoutTheLevelHasNoLine) {
  const Formula formula = parse_formula("x^2 + y^2 + z^2 + 1");
  const TickSteps tick = level_tick({0.01, -0.02, 0.005});
  const FieldGrid grid =
      sample_field(placed(formula), TickView({&tick, 1}, false), window_of(30.0), 20);
  EXPECT_TRUE(contour_of(grid, 0.0).empty());
}

}  // namespace
}  // namespace tactus::host
