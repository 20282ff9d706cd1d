// The cost of the closed forms, and the projection built on them compared with a search over every
// set of planes in extended precision.
#include "rendering/geometry/plane_solutions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "host_tools/benchmark/counted_number.h"
#include "rendering/geometry/plane_projection.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using Counted = host::CountedNumber;
using testing::share_of;
using CountedVector = Eigen::Matrix<Counted, 3, 1>;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;

CountedVector counted(const Vec3& v) {
  return {Counted(v.x()), Counted(v.y()), Counted(v.z())};
}

HalfSpace<Counted> counted(const Plane& plane) {
  return {.normal = counted(plane.normal), .offset = Counted(plane.offset)};
}

// Three walls of a corner, and a point behind all of them.
const std::array<Plane, 3> kCorner{{{.normal = Vec3{1.0, 0.2, -0.1}.normalized(), .offset = 0.01},
                                    {.normal = Vec3{-0.3, 1.0, 0.2}.normalized(), .offset = 0.02},
                                    {.normal = Vec3{0.1, -0.2, 1.0}.normalized(), .offset = 0.03}}};
const Vec3 kBehind{-0.01, -0.02, -0.03};

template <class Solve>
std::size_t products_of(Solve&& solve) {
  Counted::products = 0;
  PlaneSolution<Counted> s;
  EXPECT_TRUE(solve(counted(kBehind), s)) << "every plane must push, so that no work is skipped";
  return Counted::products;
}

TEST(PlaneSolutions, OnePlaneTakesAtMost12MultiplicationsAndDivisions) {
  const std::size_t products = products_of(
      [](const CountedVector& h, auto& s) { return solve_one_plane(h, counted(kCorner[0]), s); });
  EXPECT_LE(products, 12U);
  EXPECT_EQ(products, 6U) << "the header says so";
}

TEST(PlaneSolutions, TwoPlanesTakeAtMost33MultiplicationsAndDivisions) {
  const std::size_t products = products_of([](const CountedVector& h, auto& s) {
    return solve_two_planes(h, counted(kCorner[0]), counted(kCorner[1]), s);
  });
  EXPECT_LE(products, 33U);
  EXPECT_EQ(products, 33U) << "the header says so";
}

TEST(PlaneSolutions, ThreePlanesTakeAtMost65MultiplicationsAndDivisions) {
  const std::size_t products = products_of([](const CountedVector& h, auto& s) {
    return solve_three_planes(h, counted(kCorner[0]), counted(kCorner[1]), counted(kCorner[2]), s);
  });
  EXPECT_LE(products, 65U);
  EXPECT_EQ(products, 56U) << "the header says so";
}

TEST(PlaneSolutions, TheCountedCodeGivesTheBitsOfTheCodeInDouble) {
  PlaneSolution<Counted> s;
  PlaneSolution<double> t;
  ASSERT_TRUE(solve_three_planes(counted(kBehind), counted(kCorner[0]), counted(kCorner[1]),
                                 counted(kCorner[2]), s));
  ASSERT_TRUE(solve_three_planes(kBehind, kCorner[0], kCorner[1], kCorner[2], t));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(s.step[static_cast<Eigen::Index>(k)].value, t.step[static_cast<Eigen::Index>(k)]);
    EXPECT_EQ(s.pressure[k].value, t.pressure[k]);
  }
}

struct Optimum {
  RealVector point;
  Real distance = 0.0L;
};

// The point nearest to h on the planes of `set` taken as equalities, by the pseudo-inverse of their
// normals (Gram-Schmidt, twice); nothing where they are dependent to the last digits.
std::optional<RealVector> on_all(const RealVector& h, const std::vector<Plane>& planes,
                                 const std::vector<std::size_t>& set) {
  std::vector<RealVector> basis;
  RealVector step = RealVector::Zero();
  for (const std::size_t i : set) {
    const RealVector n = planes[i].normal.cast<Real>();
    RealVector rest = n;
    for (int pass = 0; pass < 2; ++pass) {
      for (const RealVector& b : basis) {
        rest -= b.dot(rest) * b;
      }
    }
    const Real left = rest.norm();
    if (left < 1e-17L) {
      return std::nullopt;
    }
    const RealVector b = rest / left;
    const Real missing = static_cast<Real>(planes[i].offset) - n.dot(h) - n.dot(step);
    step += missing / b.dot(n) * b;
    basis.push_back(b);
  }
  return h + step;
}

Real worst_violation(const RealVector& x, const std::vector<Plane>& planes) {
  Real worst = 0.0L;
  for (const Plane& plane : planes) {
    worst = std::max(worst, static_cast<Real>(plane.offset) - plane.normal.cast<Real>().dot(x));
  }
  return worst;
}

// Every set of at most three planes; the nearest of their points that violates no plane by more
// than `slack`. The minimum is the point of one of the sets.
Optimum search_all_sets(const RealVector& h, const std::vector<Plane>& planes, Real slack) {
  Optimum best{.point = h, .distance = std::numeric_limits<Real>::infinity()};
  const auto consider = [&](const std::vector<std::size_t>& set) {
    const auto x = on_all(h, planes, set);
    if (x && worst_violation(*x, planes) <= slack && (*x - h).norm() < best.distance) {
      best = {.point = *x, .distance = (*x - h).norm()};
    }
  };
  consider({});
  for (std::size_t i = 0; i < planes.size(); ++i) {
    consider({i});
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      consider({i, j});
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        consider({i, j, k});
      }
    }
  }
  return best;
}

// Planes through p within `angle` of one another, some of them twice or moved back out of the way,
// and up to two at large.
class Bundle {
 public:
  explicit Bundle(std::uint64_t seed) : random_(seed) {}

  std::vector<Plane> planes(const Vec3& p, const Vec3& axis, double angle) {
    std::vector<Plane> list;
    const auto through_p = [&](const Vec3& normal, double back) {
      list.push_back({.normal = normal, .offset = normal.dot(p) - back});
    };
    for (int i = 0; i < 3; ++i) {
      through_p((axis + angle * direction()).normalized(), 0.0);
    }
    list.push_back(list[0]);                   // the same twice
    through_p(list[1].normal, 1e-4 * unit());  // redundant: parallel, and farther back
    through_p((axis + 0.5 * direction()).normalized(), 0.0);
    through_p((axis + 0.5 * direction()).normalized(), 1e-3 * unit());
    std::shuffle(list.begin(), list.end(), random_);
    return list;
  }

  Vec3 direction() {
    Vec3 v;
    do {
      v = {signed_unit(), signed_unit(), signed_unit()};
    } while (v.squaredNorm() > 1.0 || v.squaredNorm() < 0.01);
    return v.normalized();
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double signed_unit() { return 2.0 * unit() - 1.0; }

 private:
  std::mt19937_64 random_;
};

// Between planes a nanoradian apart the place of the minimum is ill-posed. It must still be allowed
// and as near as any.
TEST(PlaneProjection, NearlyParallelAndRedundantPlanesGiveAnAllowedPointAsNearAsAny) {
  constexpr std::uint64_t kSeed = 20'031;
  constexpr Real kTolerance_m = 1e-15L;
  Bundle bundle(kSeed);
  for (int exponent = -12; exponent <= -1; ++exponent) {
    Real worst = 0.0L;
    Real excess = 0.0L;
    for (int k = 0; k < share_of(2'000); ++k) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", angle 1e" + std::to_string(exponent) +
                   ", case " + std::to_string(k));
      const Vec3 p = 0.1 * bundle.direction();
      const Vec3 axis = bundle.direction();
      const double angle = std::pow(10.0, exponent);
      const std::vector<Plane> planes = bundle.planes(p, axis, angle);
      // Half of them where the nearly parallel planes hold the point together.
      const Vec3 down =
          k % 2 == 0 ? Vec3{axis + 0.5 * angle * bundle.direction()} : bundle.direction();
      const Vec3 h = p - 0.005 * bundle.unit() * down;
      const PlaneProjection got = project_on_planes(h, planes);
      const RealVector exact_h = h.cast<Real>();
      const RealVector point = got.point.cast<Real>();
      const Optimum optimum = search_all_sets(exact_h, planes, 1e-18L);
      ASSERT_TRUE(got.feasible);
      ASSERT_LE(got.active_count, 3);
      worst = std::max(worst, worst_violation(point, planes));
      excess = std::max(excess, (point - exact_h).norm() - optimum.distance);
      ASSERT_LE(worst, kTolerance_m);
      ASSERT_LE(excess, kTolerance_m);
    }
  }
}

}  // namespace
}  // namespace tactus::rendering
