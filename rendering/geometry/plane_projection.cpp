// Minimise |x - h|^2 subject to n_i . x >= d_i. In three dimensions at most three planes hold the
// solution (the problem is of LP type with combinatorial dimension three), so it is found by
// exchange: keep the solution of at most three planes, find the plane that it violates most, and
// solve the problem of these at most four planes by trying the subsets that contain the new plane.
// The distance to h grows with every exchange, so no subset comes twice and the search ends.
//
// With r_i = d_i - n_i . h the solution of a set of planes taken as equalities is
//   one:    step = r n
//   two:    step = r1 n1 + l2 e, e = n2 - c n1, c = n1 . n2, l2 = (r2 - c r1) / |e|^2, l1 = r1 - c
//   l2 three:  step = (r1 n2 x n3 + r2 n3 x n1 + r3 n1 x n2) / D, D = n1 . (n2 x n3), l1 = step .
//   (n2 x n3) / D, cyclic
// and it is the minimum over those planes if every l > 0. Working from h keeps the rounding
// relative to the depth, not to the size of the world.
#include "rendering/geometry/plane_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

struct Solution {
  Vec3 step = Vec3::Zero();
  std::array<std::uint8_t, 3> active{};
  std::array<double, 3> pressure{};
  std::uint8_t count = 0;
};

struct Problem {
  const Vec3& h;
  std::span<const Plane> planes;

  // How far h would have to move along the normal to satisfy plane i.
  [[nodiscard]] double residual(std::size_t i) const {
    return planes[i].offset - planes[i].normal.dot(h);
  }
  // Negative where the step leaves plane i violated.
  [[nodiscard]] double slack(std::size_t i, const Vec3& step) const {
    return planes[i].normal.dot(step) - residual(i);
  }
  // What rounding makes of a slack of zero: a violation below it is none.
  [[nodiscard]] double rounding(const Vec3& step) const { return 4e-16 * (h.norm() + step.norm()); }
};

bool solve_one(const Problem& problem, Solution& s) {
  s.pressure[0] = problem.residual(s.active[0]);
  s.step = s.pressure[0] * problem.planes[s.active[0]].normal;
  return s.pressure[0] > 0.0;
}

bool solve_two(const Problem& problem, Solution& s) {
  const Vec3& n0 = problem.planes[s.active[0]].normal;
  const Vec3& n1 = problem.planes[s.active[1]].normal;
  // Within the first plane, across the crease: n1 without its part along n0.
  const Vec3 across = n0.cross(n1).cross(n0);
  const double squared_sine = across.squaredNorm();
  constexpr double kParallel = 1e-22;  // below it the angle is rounding: one of the two is enough
  if (squared_sine < kParallel) {
    return false;
  }
  const double cosine = n0.dot(n1);
  const double first = problem.residual(s.active[0]);
  const double second = (problem.residual(s.active[1]) - cosine * first) / squared_sine;
  s.pressure[0] = first - cosine * second;
  s.pressure[1] = second;
  s.step = first * n0 + second * across;
  return s.pressure[0] > 0.0 && s.pressure[1] > 0.0;
}

bool solve_three(const Problem& problem, Solution& s) {
  const Vec3& n0 = problem.planes[s.active[0]].normal;
  const Vec3& n1 = problem.planes[s.active[1]].normal;
  const Vec3& n2 = problem.planes[s.active[2]].normal;
  const std::array<Vec3, 3> dual{n1.cross(n2), n2.cross(n0), n0.cross(n1)};
  const double volume = n0.dot(dual[0]);
  constexpr double kFlat = 1e-14;  // below it the volume is rounding: the normals are coplanar
  if (std::abs(volume) < kFlat) {
    return false;
  }
  s.step = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    s.step += problem.residual(s.active[i]) * dual[i];
  }
  s.step /= volume;
  for (std::size_t i = 0; i < 3; ++i) {
    s.pressure[i] = s.step.dot(dual[i]) / volume;
  }
  return std::ranges::all_of(s.pressure, [](double l) { return l > 0.0; });
}

bool solve(const Problem& problem, Solution& s) {
  switch (s.count) {
    case 1:
      return solve_one(problem, s);
    case 2:
      return solve_two(problem, s);
    default:
      return solve_three(problem, s);
  }
}

bool contains(const Solution& s, std::uint8_t plane) {
  return std::find(s.active.begin(), s.active.begin() + s.count, plane) !=
         s.active.begin() + s.count;
}

// The largest violation that `trial` leaves among the planes of `base` and the entering plane, 0 if
// none.
double violation_within(const Problem& problem, const Solution& base, std::uint8_t entering,
                        const Solution& trial) {
  double worst = contains(trial, entering) ? 0.0 : -problem.slack(entering, trial.step);
  for (std::uint8_t i = 0; i < base.count; ++i) {
    if (!contains(trial, base.active[i])) {
      worst = std::max(worst, -problem.slack(base.active[i], trial.step));
    }
  }
  return worst;
}

// The minimum over the planes of `base` and the entering one: the subset with positive pressures
// that violates the rest least. False if no subset qualifies.
bool exchange(const Problem& problem, std::uint8_t entering, Solution& base) {
  constexpr std::array<std::uint8_t, 7> kSubsets{0b000, 0b001, 0b010, 0b100, 0b011, 0b101, 0b110};
  Solution best;
  double best_violation = std::numeric_limits<double>::infinity();
  for (const std::uint8_t subset : kSubsets) {
    if ((subset >> base.count) != 0) {
      continue;
    }
    Solution trial;
    for (std::size_t i = 0; i < base.active.size(); ++i) {
      if ((subset >> i & 1) != 0) {
        trial.active[trial.count++] = base.active[i];
      }
    }
    trial.active[trial.count++] = entering;
    if (!solve(problem, trial)) {
      continue;
    }
    const double violation = violation_within(problem, base, entering, trial);
    if (violation < best_violation) {
      best_violation = violation;
      best = trial;
    }
    if (violation <= problem.rounding(trial.step)) {
      break;
    }
  }
  base = best;
  return best.count != 0;
}

}  // namespace

PlaneProjection project_on_planes(const Vec3& h, std::span<const Plane> planes) {
  constexpr double kRounding_m = 1e-12;
  constexpr double kNearParallel = 1e-9;  // what nearly parallel planes make of that rounding
  // Between nearly parallel planes the distance grows by less than it can be told apart: such
  // exchanges are allowed, but few.
  constexpr double kUnclear = 1e-9;
  constexpr int kMostStalls = 6;
  int stalls = 0;
  const Problem problem{h, planes};
  const std::size_t most_exchanges = 8 + 4 * planes.size();
  Solution solution;
  PlaneProjection result;
  result.feasible = false;
  for (std::size_t k = 0; k < most_exchanges; ++k) {
    double worst = -problem.rounding(solution.step);
    std::size_t entering = planes.size();
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double slack = problem.slack(i, solution.step);
      if (slack < worst && !contains(solution, static_cast<std::uint8_t>(i))) {
        worst = slack;
        entering = i;
      }
    }
    if (entering == planes.size()) {
      result.feasible = true;
      break;
    }
    Solution next = solution;
    const bool exchanged = exchange(problem, static_cast<std::uint8_t>(entering), next);
    const double gain = next.step.squaredNorm() - solution.step.squaredNorm();
    const double unclear = kUnclear * solution.step.squaredNorm();
    stalls += gain > unclear ? 0 : 1;
    if (!exchanged || gain < -unclear || stalls > kMostStalls) {
      // No way forward: either the planes contradict each other, or what is violated is rounding.
      result.feasible = -worst <= kRounding_m + kNearParallel * solution.step.norm();
      break;
    }
    solution = next;
  }
  result.point = h + solution.step;
  result.active = solution.active;
  result.pressure_m = solution.pressure;
  result.active_count = solution.count;
  return result;
}

}  // namespace tactus::rendering
