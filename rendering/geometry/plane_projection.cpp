// Minimise |x - h|^2 subject to n_i . x >= d_i. In three dimensions at most three planes hold the
// solution (the problem is of LP type with combinatorial dimension three), so it is found by
// exchange: keep the solution of at most three planes, find the plane that it violates most, and
// solve the problem of these at most four planes by trying the subsets that contain the new plane.
// The distance to h grows with every exchange, so no subset comes twice and the search ends.
#include "rendering/geometry/plane_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

// A solution: the step from h and the planes that hold it.
struct Solution {
  PlaneSolution<double> at;
  std::array<std::uint8_t, 3> active{};
  std::uint8_t count = 0;
};

// The tool and the planes.
struct Problem {
  const Vec3& h;
  std::span<const Plane> planes;

  [[nodiscard]] const Plane& active(const Solution& s, std::size_t i) const {
    return planes[s.active[i]];
  }
  // Returns how far h + step is in front of plane i, m; negative if it violates the plane.
  [[nodiscard]] double slack(std::size_t i, const Vec3& step) const {
    return planes[i].normal.dot(step) - planes[i].residual(h);
  }
  // Returns the rounding error of a slack; a smaller violation counts as none.
  [[nodiscard]] double rounding(const Vec3& step) const { return 4e-16 * (h.norm() + step.norm()); }
};

// Solves for the planes that are listed in `s`. Returns true if all of them push.
bool solve(const Problem& problem, Solution& s) {
  switch (s.count) {
    case 1:
      return solve_one_plane(problem.h, problem.active(s, 0), s.at);
    case 2:
      return solve_two_planes(problem.h, problem.active(s, 0), problem.active(s, 1), s.at);
    default:
      return solve_three_planes(problem.h, problem.active(s, 0), problem.active(s, 1),
                                problem.active(s, 2), s.at);
  }
}

bool contains(const Solution& s, std::uint8_t plane) {
  return std::find(s.active.begin(), s.active.begin() + s.count, plane) !=
         s.active.begin() + s.count;
}

// Returns the largest violation that `trial` leaves among the planes of `base` and the entering
// plane, 0 if none.
double violation_within(const Problem& problem, const Solution& base, std::uint8_t entering,
                        const Solution& trial) {
  double worst = contains(trial, entering) ? 0.0 : -problem.slack(entering, trial.at.step);
  for (std::uint8_t i = 0; i < base.count; ++i) {
    if (!contains(trial, base.active[i])) {
      worst = std::max(worst, -problem.slack(base.active[i], trial.at.step));
    }
  }
  return worst;
}

// Replaces `base` by the minimum over its planes and the entering one: the subset with positive
// pressures that violates the rest least. Returns false if no subset qualifies. All subsets hold
// the entering plane, as the old solution violates it.
bool exchange(const Problem& problem, std::uint8_t entering, Solution& base) {
  // Bit i stands for plane i of `base`. The single planes come before the pairs: they are cheaper,
  // and mostly enough.
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
    if (violation <= problem.rounding(trial.at.step)) {
      break;
    }
  }
  base = best;
  return best.count != 0;
}

// Projects on a single plane, which is the case of nearly every tick.
PlaneProjection project_on_one(const Problem& problem) {
  PlaneSolution<double> s;
  const bool pushes = solve_one_plane(problem.h, problem.planes[0], s) &&
                      s.pressure[0] > problem.rounding(Vec3::Zero());
  return pushes ? PlaneProjection{.point = problem.h + s.step,
                                  .pressure_m = {s.pressure[0], 0.0, 0.0},
                                  .active_count = 1}
                : PlaneProjection{.point = problem.h};
}

}  // namespace

PlaneProjection project_on_planes(const Vec3& h, std::span<const Plane> planes) {
  constexpr double kRounding_m = 1e-12;
  // The share of the step that nearly parallel planes make of that rounding.
  constexpr double kNearParallel = 1e-9;
  // Between nearly parallel planes the distance grows by less than it can be told apart: such
  // exchanges are allowed, but few.
  constexpr double kUnclear = 1e-9;
  constexpr int kMostStalls = 6;
  int stalls = 0;
  const Problem problem{h, planes};
  if (planes.size() == 1) {
    return project_on_one(problem);
  }
  // The search ends by itself; this bounds its time whatever rounding does.
  const std::size_t most_exchanges = 8 + 4 * planes.size();
  Solution solution;
  PlaneProjection result;
  result.feasible = false;
  for (std::size_t k = 0; k < most_exchanges; ++k) {
    double worst = -problem.rounding(solution.at.step);
    // The plane that the solution violates most enters.
    std::size_t entering = planes.size();
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double slack = problem.slack(i, solution.at.step);
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
    const double gain = next.at.step.squaredNorm() - solution.at.step.squaredNorm();
    const double unclear = kUnclear * solution.at.step.squaredNorm();
    stalls += gain > unclear ? 0 : 1;
    if (!exchanged || gain < -unclear || stalls > kMostStalls) {
      // No exchange is left: either the planes contradict each other, or the violation is rounding.
      result.feasible = -worst <= kRounding_m + kNearParallel * solution.at.step.norm();
      break;
    }
    solution = next;
  }
  result.point = h + solution.at.step;
  result.active = solution.active;
  result.pressure_m = solution.at.pressure;
  result.active_count = solution.count;
  return result;
}

}  // namespace tactus::rendering
