// Formulas whose zeros are known in advance: all that have some are found, down to 20 um, and all
// that have none are told so.
#include "host_tools/bake/formula/zero_search.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "host_tools/bake/formula/formula_parser.h"
#include "host_tools/bake/formula/zero_bounds.h"
#include "tests/support/share.h"

namespace tactus::host {
namespace {

using rendering::Box;

// The formulas are in millimetres.
constexpr double kMillimetre_m = 0.001;
constexpr double kHalfBox = 30.0;

Box cube_about_zero(double half) {
  return {.lower = Vec3::Constant(-half), .upper = Vec3::Constant(half)};
}

ZeroSearch zero_of(const std::string& text, const Box& bounds = cube_about_zero(2.0),
                   double unit_m = 1.0) {
  const Formula formula = parse_formula(text);
  return search_zero(formula.view(), bounds, unit_m);
}

TEST(ZeroSearch, FindsThinAndSmallShapes) {
  const Box box = cube_about_zero(60.0);
  for (const char* text :
       {"translate(box(100, 0.12, 100), 1, 13.3, 2)", "translate(box(100, 0.02, 100), 1, 13.3, 2)",
        "rotate(translate(box(100, 0.02, 100), 0, 13.3, 0), 1, 2, 3, 33)",
        "translate(sphere(0.6), 13.3, 7.1, -9.2)", "(x-31.7)^2 + (y-7.1)^2 + (z+9.2)^2 - 0.01^2",
        "shell(sphere(25), 0.02)", "x^2 + x*y + y^2 - 1", "0.01 - abs(y - 0.37)"}) {
    EXPECT_EQ(zero_of(text, box, kMillimetre_m).kind, ZeroKind::crossed) << text;
  }
}

TEST(ZeroSearch, TellsATouchFromACrossingAndFromAMiss) {
  for (const char* text :
       {"x^2", "-x^2", "abs(x - 0.37)", "(x - 0.37)^4", "shell(sphere(1), 0)", "x^2 + y^2",
        "x^2 + y^2 + z^2", "(x^2 + y^2 + z^2 - 1)^2", "sin(3*x) + 1", "x^2 - 2*x*y + y^2"}) {
    EXPECT_EQ(zero_of(text).kind, ZeroKind::touched) << text;
  }
  EXPECT_EQ(zero_of("x^2 - 0.00001^2").kind, ZeroKind::crossed);
  EXPECT_EQ(zero_of("x^2 + 0.00001^2").kind, ZeroKind::none);
  EXPECT_EQ(zero_of("exp(x)").kind, ZeroKind::none);
  EXPECT_EQ(zero_of("sin(3*x) + 1.000001").kind, ZeroKind::none);
  EXPECT_NEAR(zero_of("sin(3*x) + 1.000001").value, 1e-6, 1e-8);
  EXPECT_TRUE(zero_of("-x^2").is_below);
}

// The proxy needs a slope: it would fall through a formula that is 0 all about.
TEST(ZeroSearch, AFormulaThatIsZeroInARegionHasNoSurface) {
  EXPECT_EQ(zero_of("max(x - 1, 0)").kind, ZeroKind::flat);
  EXPECT_EQ(zero_of("x^64").kind, ZeroKind::flat);
}

// Interval arithmetic does not see that this is (x - y)^2 and a little.
TEST(ZeroSearch, SaysHowNearItHasLookedWhereItProvesNothing) {
  const ZeroSearch search = zero_of("x^2 - 2*x*y + y^2 + 1e-6");
  EXPECT_EQ(search.kind, ZeroKind::undecided);
  EXPECT_NEAR(search.value, 1e-6, 1e-9);
  EXPECT_GT(search.undecided_size, 0.0);
  EXPECT_LT(search.undecided_size, 0.2);
  EXPECT_NEAR(search.undecided.x(), search.undecided.y(), 0.2);
}

TEST(ZeroBounds, HoldTheShapeTightly) {
  const Formula plate = parse_formula("translate(box(10, 0.02, 4), 1, 13.3, 2)");
  const Box box = bounds_of_zeros(plate.view(), cube_about_zero(60.0));
  const Vec3 lower(-4.0, 13.29, 0.0);
  const Vec3 upper(6.0, 13.31, 4.0);
  EXPECT_TRUE((box.lower.array() < lower.array()).all()) << box.lower.transpose();
  EXPECT_TRUE((box.upper.array() > upper.array()).all()) << box.upper.transpose();
  EXPECT_TRUE(((box.upper - box.lower).array() < 1.2 * (upper - lower).array()).all());
}

// A formula with its zeros known: the distance of a point from them, or nothing if there are none.
struct Known {
  std::string text;
  std::function<double(const Vec3&)> distance;
};

// Draws formulas of shapes in a box of 60 mm.
class FormulaDrawing {
 public:
  explicit FormulaDrawing(std::uint64_t seed) : random_(seed) {}

  // A shape with an inside, as thin as 20 um, in any of the guises that keep its zeros.
  Known solid() {
    const Known shape = sheet();
    const double half = 0.5 * thickness();
    const std::string text = fmt::format("(abs({}) - {})", shape.text, half);
    const std::vector<std::string> guises{
        text,
        fmt::format("{}^3", text),
        fmt::format("{} * (1 + x^2)", text),
        fmt::format("exp({}) - 1", text),
        fmt::format("{0} / (1 + {0}^2)", text),
        fmt::format("({})^2 - {}^2", shape.text, half),
        fmt::format("-{}", text),
    };
    return {.text = any(guises),
            .distance = [=](const Vec3& p) { return std::abs(shape.distance(p) - half); }};
  }

  // A small ball, as a sum of squares.
  Known ball() {
    const Vec3 c = place(0.9);
    const double r = 0.5 * thickness();
    return {
        .text = fmt::format("(x - {})^2 + (y - {})^2 + (z - {})^2 - {}^2", c.x(), c.y(), c.z(), r),
        .distance = [=](const Vec3& p) { return std::abs((p - c).norm() - r); }};
  }

  // A sheet that the formula touches without changing its sign.
  Known touch() {
    const Known shape = sheet();
    const std::string& text = shape.text;
    return {.text = any<std::string>({fmt::format("abs({})", text), fmt::format("({})^2", text),
                                      fmt::format("({})^4", text), fmt::format("-({})^2", text),
                                      fmt::format("shell({}, 0)", text),
                                      fmt::format("({})^2 * (1 + y^2)", text)}),
            .distance = shape.distance};
  }

  // A formula that comes as near to 0 as a thickness and no nearer.
  Known none() {
    const std::string text = sheet().text;
    const double above = thickness();
    const Vec3 c = place(0.9);
    return {
        .text = any<std::string>(
            {fmt::format("abs({}) + {}", text, above), fmt::format("({})^2 + {}^2", text, above),
             fmt::format("-abs({}) - {}", text, above), fmt::format("exp({})", text),
             fmt::format("length(x - {}, y - {}, z - {}) + {}", c.x(), c.y(), c.z(), above),
             // Beyond the bounds.
             fmt::format("abs(x - {}) - {}", kHalfBox + 2.0 * above, above),
             fmt::format("(x + {})^2 + (y - {})^2 + (z - {})^2 - {}^2", kHalfBox + 2.0 * above,
                         c.y(), c.z(), above)}),
        .distance = {}};
  }

 private:
  // A plane, a sphere, a torus or a cylinder without ends, at any place: its signed distance.
  Known sheet() {
    const Vec3 c = place(0.5);
    const double r = number(2.0, 12.0);
    const auto at = [&](const std::string& text) {
      return fmt::format("translate({}, {}, {}, {})", text, c.x(), c.y(), c.z());
    };
    switch (static_cast<int>(number(0.0, 4.0))) {
      case 0: {
        const Vec3 n = place(1.0).normalized();
        return {.text = fmt::format("{}*(x - {}) + {}*(y - {}) + {}*(z - {})", n.x(), c.x(), n.y(),
                                    c.y(), n.z(), c.z()),
                .distance = [=](const Vec3& p) { return std::abs(n.dot(p - c)); }};
      }
      case 1:
        return {.text = at(fmt::format("sphere({})", r)),
                .distance = [=](const Vec3& p) { return std::abs((p - c).norm() - r); }};
      case 2:
        return {.text = at(fmt::format("torus({}, {})", r, 0.3 * r)),
                .distance = [=](const Vec3& p) {
                  const Vec3 q = p - c;
                  return std::abs(std::hypot(std::hypot(q.x(), q.y()) - r, q.z()) - 0.3 * r);
                }};
      default:
        return {.text = fmt::format("length(x - {}, y - {}) - {}", c.x(), c.y(), r),
                .distance = [=](const Vec3& p) {
                  return std::abs(std::hypot(p.x() - c.x(), p.y() - c.y()) - r);
                }};
    }
  }

  double number(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Vec3 place(double share) {
    const auto one = [&] { return number(-share * kHalfBox, share * kHalfBox); };
    const double x = one();
    const double y = one();
    return {x, y, one()};
  }
  // The thickness is 20 um to 2 mm.
  double thickness() { return 0.02 * std::pow(100.0, number(0.0, 1.0)); }
  template <class T>
  T any(const std::vector<T>& of) {
    return of[std::uniform_int_distribution<std::size_t>(0, of.size() - 1)(random_)];
  }

  std::mt19937_64 random_;
};

TEST(ZeroSearch, OfAThousandRandomFormulasIsRight) {
  constexpr std::uint64_t kZeroSeed = 20261127;
  constexpr double kNear = 1e-5;
  FormulaDrawing drawing(kZeroSeed);
  const int count = testing::share_of(1000);
  for (int i = 0; i < count; ++i) {
    const int kind = i % 5;
    const Known known = kind == 0   ? drawing.touch()
                        : kind == 1 ? drawing.ball()
                        : kind < 4  ? drawing.solid()
                                    : drawing.none();
    const ZeroSearch search = zero_of(known.text, cube_about_zero(kHalfBox), kMillimetre_m);
    const bool is_found = search.kind == ZeroKind::crossed || search.kind == ZeroKind::touched;
    ASSERT_EQ(is_found, static_cast<bool>(known.distance))
        << "seed " << kZeroSeed << ", number " << i << ": " << known.text << ", kind "
        << static_cast<int>(search.kind) << ", " << search.value << " at "
        << search.place.transpose();
    if (is_found) {
      EXPECT_LT(known.distance(search.place), kNear) << known.text;
    }
    EXPECT_NE(search.kind, ZeroKind::undecided) << known.text;
  }
}

}  // namespace
}  // namespace tactus::host
