#include "host_tools/friction/fit_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host_tools/friction/fit_start.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;

// Enough to tell good starts from bad ones, and enough to finish.
constexpr SearchLimits kShortSearch{.most_evaluations = 15, .tolerance = 1e-4};
constexpr SearchLimits kWholeSearch{.most_evaluations = 80, .tolerance = 1e-9};

// Returns the least sum of squares that Levenberg and Marquardt's method finds from a start.
Solution search(const FitPoint& start, const FrictionRecord& record, const SearchLimits& limits) {
  const auto rows = static_cast<Eigen::Index>(record.rows());
  const Eigen::Map<const Eigen::VectorXd> measured(record.force_N.data(), rows);
  const auto free = static_cast<Eigen::Index>(start.free_quantities().size());
  Solution solution{.point = start, .squares = {}};
  solution.squares = least_squares(
      [&](const Eigen::VectorXd& by, Eigen::VectorXd& out) {
        model_forces(start.moved(by), record, out);
        out -= measured;
      },
      rows, Eigen::VectorXd::Zero(free), limits);
  solution.point = start.moved(solution.squares.parameters);
  return solution;
}

// Returns the mean normal force over the rows in contact, N.
double mean_contact_force(const FrictionRecord& record) {
  double sum = 0.0;
  double rows = 0.0;
  for (const double force_N : record.normal_force_N) {
    sum += std::max(force_N, 0.0);
    rows += force_N > 0.0 ? 1.0 : 0.0;
  }
  return rows > 0.0 ? sum / rows : 1.0;
}

// Returns stiffnesses in even ratios, from presliding within a tick to presliding all along the
// record.
std::vector<double> stiffnesses(const FitPoint& point, const RecordTraits& traits) {
  constexpr int kStiffnesses = 40;
  // Presliding within this share of a small step cannot be told from a rigid model.
  constexpr double kBelowAStep = 0.1;
  const double longest_m = traits.travel_m / static_cast<double>(traits.reversals + 1);
  const double shortest_m = std::min(kBelowAStep * traits.small_step_m, 1e-3 * longest_m);
  std::vector<double> result;
  for (int i = 0; i <= kStiffnesses; ++i) {
    const double share = static_cast<double>(i) / kStiffnesses;
    result.push_back(point.force_scale_N /
                     std::exp(std::lerp(std::log(shortest_m), std::log(longest_m), share)));
  }
  return result;
}

// A point and how well it fits.
struct Candidate {
  FitPoint point;
  double sum_of_squares = std::numeric_limits<double>::infinity();
};

// Returns the stiffness, of many, with which presliding fits best, with a damping of `time_s` times
// the stiffness.
Candidate best_bristle(const FitPoint& point, const FrictionRecord& record,
                       const RecordTraits& traits, double time_s) {
  // Times Fc: the record may never have got there.
  constexpr std::array kLevels{1.0, 1.6};
  const double normal_N = mean_contact_force(record);
  Candidate best{.point = point};
  for (const double stiffness : stiffnesses(point, traits)) {
    for (const double level : kLevels) {
      FitPoint now = point;
      now.set(Quantity::coulomb, level * point[Quantity::coulomb]);
      now.set(Quantity::stiffness, stiffness);
      now.set(Quantity::damping, time_s * stiffness / normal_N);
      const double sum = sum_of_squares(now, record);
      if (sum < best.sum_of_squares) {
        best = {.point = now, .sum_of_squares = sum};
      }
    }
  }
  return best;
}

// Returns a start for each damping that does not fit much worse than the best. A bristle that is
// too stiff can stand for one that is damped, and a search does not come back from there.
std::vector<FitPoint> damped_starts(const FitPoint& point, const FrictionRecord& record,
                                    const RecordTraits& traits) {
  // The times sigma1 N / sigma0.
  constexpr std::array kTimes_s{1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2};
  constexpr double kMuchWorse = 2.0;
  std::vector<Candidate> candidates;
  candidates.reserve(kTimes_s.size());
  for (const double time_s : kTimes_s) {
    candidates.push_back(best_bristle(point, record, traits, time_s));
  }
  const double least =
      std::ranges::min_element(candidates, {}, &Candidate::sum_of_squares)->sum_of_squares;
  std::vector<FitPoint> starts;
  for (const Candidate& candidate : candidates) {
    if (candidate.sum_of_squares <= kMuchWorse * least) {
      starts.push_back(candidate.point);
    }
  }
  return starts;
}

}  // namespace

double stiffest(const FitPoint& point, const RecordTraits& traits) {
  return stiffnesses(point, traits).front();
}

Solution solve(const FitPoint& start, const FrictionRecord& record) {
  return search(start, record, kWholeSearch);
}

std::vector<FitPoint> starts_of(const FrictionRecord& record, const RecordTraits& traits,
                                FrictionKind kind, const FitOptions& options) {
  const bool falls = rendering::has_static_level(kind);
  const SteadyCurve curve = steady_curve(record, traits, falls);
  FitPoint point{.kind = kind, .force_scale_N = curve.coulomb * mean_contact_force(record)};
  point.set(Quantity::coulomb, curve.coulomb);
  point.set(Quantity::excess, curve.excess);
  point.set(Quantity::viscous, curve.viscous_s_per_m);
  point.set(Quantity::stribeck_velocity, curve.stribeck_velocity_m_per_s);
  point.set(Quantity::exponent, options.exponent);
  point.set_free(Quantity::coulomb, true);
  point.set_free(Quantity::viscous, true);
  point.set_free(Quantity::excess, falls);
  point.set_free(Quantity::stribeck_velocity, falls);
  point.set_free(Quantity::exponent, falls && options.fits_exponent);
  if (!rendering::has_bristles(kind)) {
    return {point};
  }
  // The bristle of the first row holds at most Fc; the measured force says how much of it.
  const double strongest_N = curve.coulomb * std::max(record.normal_force_N[0], 0.0);
  point.set(Quantity::start_force, std::clamp(record.force_N[0], -strongest_N, strongest_N));
  point.set_free(Quantity::start_force, true);
  point.set_free(Quantity::stiffness, true);
  if (!rendering::is_damped(kind)) {
    return {best_bristle(point, record, traits, 0.0).point};
  }
  point.set_free(Quantity::damping, true);
  return damped_starts(point, record, traits);
}

Solution best_solution(std::span<const FitPoint> starts, const FrictionRecord& record) {
  Solution best = search(starts.front(), record, kShortSearch);
  const auto attempt = [&](const FitPoint& point, const SearchLimits& limits) {
    Solution now = search(point, record, limits);
    if (now.squares.sum_of_squares < best.squares.sum_of_squares) {
      best = std::move(now);
    }
  };
  for (const FitPoint& start : starts.subspan(1)) {
    attempt(start, kShortSearch);
  }
  // The sum of squares may have several minima in vs, so the search also starts far to both sides.
  if (starts.front().is_free(Quantity::stribeck_velocity)) {
    for (const double factor : {0.2, 5.0}) {
      FitPoint other = starts.front();
      other.set(Quantity::stribeck_velocity, factor * other[Quantity::stribeck_velocity]);
      attempt(other, kShortSearch);
    }
  }
  // Nothing in the file tells whose velocity a row has; both meanings are tried and the better is
  // kept.
  FitPoint of_ticks = best.point;
  of_ticks.row_time = RowTime::tick;
  best = search(best.point, record, kWholeSearch);
  attempt(of_ticks, kWholeSearch);
  return best;
}

}  // namespace tactus::host
