#include "host_tools/friction/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host_tools/friction/fit_space.h"
#include "host_tools/friction/fit_start.h"
#include "host_tools/friction/least_squares.h"
#include "host_tools/friction/parameter_names.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;

constexpr std::array kFittedKinds{FrictionKind::coulomb_viscous, FrictionKind::stribeck,
                                  FrictionKind::dahl, FrictionKind::lugre};

// From that standard error of a logarithm on, plus and minus two of it reach 0.
constexpr double kUnknownFrom = 0.5;
constexpr double kTwoSided95 = 1.96;

// Rows a reversal on which the force is on its way. With fewer the turn itself, which happens
// between two rows, decides what the model does in them.
constexpr std::size_t kPreslidingRows = 2;

constexpr SearchLimits kShortSearch{.most_evaluations = 15, .tolerance = 1e-4};
constexpr SearchLimits kWholeSearch{.most_evaluations = 80, .tolerance = 1e-9};

struct Solution {
  FitPoint point;
  LeastSquares squares;
};

Solution solve(const FitPoint& start, const FrictionRecord& record, const SearchLimits& limits) {
  const auto rows = static_cast<Eigen::Index>(record.rows()) - 1;
  const Eigen::Map<const Eigen::VectorXd> measured(record.force_N.data() + 1, rows);
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

// The stiffness, of many, whose presliding fits best.
void find_stiffness(FitPoint& point, const FrictionRecord& record, const RecordTraits& traits) {
  constexpr int kStiffnesses = 50;
  constexpr std::array kLevels{1.0, 1.6};  // times Fc: the record may never have got there
  constexpr double kBelowAStep = 0.1;
  const double longest_m = traits.travel_m / static_cast<double>(traits.reversals + 1);
  const double shortest_m = std::min(kBelowAStep * traits.small_step_m, 1e-3 * longest_m);
  FitPoint best = point;
  double least = std::numeric_limits<double>::infinity();
  for (const double level : kLevels) {
    FitPoint now = point;
    now.set(Quantity::coulomb, level * point[Quantity::coulomb]);
    for (int i = 0; i <= kStiffnesses; ++i) {
      const double share = static_cast<double>(i) / kStiffnesses;
      const double length_m = std::exp(std::lerp(std::log(shortest_m), std::log(longest_m), share));
      now.set(Quantity::stiffness, point.force_scale_N / length_m);
      const double sum = sum_of_squares(now, record);
      if (sum < least) {
        least = sum;
        best = now;
      }
    }
  }
  point = best;
}

double mean_contact_force(const FrictionRecord& record) {
  double sum = 0.0;
  double rows = 0.0;
  for (const double force_N : record.normal_force_N) {
    sum += std::max(force_N, 0.0);
    rows += force_N > 0.0 ? 1.0 : 0.0;
  }
  return rows > 0.0 ? sum / rows : 1.0;
}

void find_damping(FitPoint& point, const FrictionRecord& record) {
  constexpr std::array kTimes_s{1e-4, 1e-3, 1e-2, 1e-1};  // sigma1 N / sigma0
  const double per_second = point[Quantity::stiffness] / mean_contact_force(record);
  FitPoint best = point;
  double least = std::numeric_limits<double>::infinity();
  for (const double time_s : kTimes_s) {
    FitPoint now = point;
    now.set(Quantity::damping, time_s * per_second);
    const double sum = sum_of_squares(now, record);
    if (sum < least) {
      least = sum;
      best = now;
    }
  }
  point = best;
}

FitPoint start_of(const FrictionRecord& record, const RecordTraits& traits, FrictionKind kind,
                  const FitOptions& options) {
  const bool falls = kind == FrictionKind::stribeck || kind == FrictionKind::lugre;
  const bool has_bristles = kind == FrictionKind::dahl || kind == FrictionKind::lugre;
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
  if (has_bristles) {
    point.set_free(Quantity::stiffness, true);
    point.set_free(Quantity::start_force, true);
    const double strongest_N = curve.coulomb * record.normal_force_N[0];
    point.set(Quantity::start_force, std::clamp(record.force_N[0], -strongest_N, strongest_N));
    find_stiffness(point, record, traits);
  }
  if (kind == FrictionKind::lugre) {
    point.set_free(Quantity::damping, true);
    find_damping(point, record);
  }
  return point;
}

// From the start, and from others that know the fall with speed less well: each a short way, the
// best to the end.
Solution best_solution(const FitPoint& start, const FrictionRecord& record) {
  Solution best = solve(start, record, kShortSearch);
  if (start.is_free(Quantity::stribeck_velocity)) {
    for (const double factor : {0.2, 5.0}) {
      FitPoint other = start;
      other.set(Quantity::stribeck_velocity, factor * start[Quantity::stribeck_velocity]);
      Solution now = solve(other, record, kShortSearch);
      if (now.squares.sum_of_squares < best.squares.sum_of_squares) {
        best = std::move(now);
      }
    }
  }
  return solve(best.point, record, kWholeSearch);
}

double error_of(const Solution& solution, Quantity quantity) {
  const std::vector<Quantity> free = solution.point.free_quantities();
  const auto found = std::ranges::find(free, quantity);
  return found == free.end() ? 0.0 : solution.squares.standard_errors(found - free.begin());
}

// Out of the search: at 0 where the model goes without it, else where it is.
void take_out(FitPoint& point, Quantity quantity) {
  const auto hold = [&point](Quantity q) { point.set_free(q, false); };
  const auto drop = [&](Quantity q) {
    hold(q);
    point.set(q, 0.0);
  };
  switch (quantity) {
    case Quantity::excess:
      drop(Quantity::excess);
      hold(Quantity::stribeck_velocity);
      hold(Quantity::exponent);
      break;
    case Quantity::stiffness:
      hold(Quantity::stiffness);
      hold(Quantity::start_force);
      if (point.is_free(Quantity::damping)) {
        drop(Quantity::damping);
      }
      break;
    case Quantity::viscous:
    case Quantity::damping:
      drop(quantity);
      break;
    default:
      hold(quantity);
  }
}

// The quantity that the data tell least about, if they do not tell enough: the fall with speed as a
// whole before its parts.
std::optional<Quantity> least_known(const Solution& solution) {
  if (!(error_of(solution, Quantity::excess) < kUnknownFrom)) {
    return Quantity::excess;
  }
  std::optional<Quantity> worst;
  double most = kUnknownFrom;
  for (const Quantity q : solution.point.free_quantities()) {
    const double error = error_of(solution, q);
    if (q != Quantity::coulomb && q != Quantity::start_force && !(error < most)) {
      worst = q;
      most = error;
    }
  }
  return worst;
}

bool shows_presliding(const RecordTraits& traits) {
  return traits.presliding_rows >= kPreslidingRows * (traits.reversals + 1);
}

// A stiffness that the data do not tell still has a least value: where the sum of squares has
// risen by what chance raises it in one of twenty cases. 0 if there is none.
double least_stiffness(const Solution& solution, const FrictionRecord& record) {
  constexpr double kByChance = 3.84;
  constexpr int kHalvings = 60;
  constexpr int kBisections = 6;
  const double limit =
      solution.squares.sum_of_squares * (1.0 + kByChance / static_cast<double>(record.rows()));
  FitPoint point = solution.point;
  const auto is_enough = [&](double stiffness) {
    point.set(Quantity::stiffness, stiffness);
    return sum_of_squares(point, record) <= limit;
  };
  double enough = solution.point[Quantity::stiffness];
  int halvings = 0;
  while (halvings < kHalvings && is_enough(0.5 * enough)) {
    enough *= 0.5;
    ++halvings;
  }
  double too_little = 0.5 * enough;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(enough * too_little);
    (is_enough(middle) ? enough : too_little) = middle;
  }
  return halvings < kHalvings ? enough : 0.0;
}

std::string why_no_stiffness(const Solution& solution, const FrictionRecord& record,
                             const RecordTraits& traits) {
  const double least = least_stiffness(solution, record);
  const std::string bound =
      least > 0.0 ? fmt::format("; it is at least {:.2g} N/m", least) : std::string{};
  if (traits.reversals == 0 && !shows_presliding(traits)) {
    return "no presliding in the data: the motion neither starts at rest nor turns back" + bound;
  }
  if (!shows_presliding(traits)) {
    return "no presliding in the data: at a reversal the force is on the other side within a row "
           "or "
           "two; sample faster, or reverse more slowly" +
           bound;
  }
  return "the noise hides presliding" + bound;
}

std::string why_unknown(Quantity quantity, const Solution& solution, const FrictionRecord& record,
                        const RecordTraits& traits) {
  switch (quantity) {
    case Quantity::excess:
      return fmt::format(
          "no fall of the friction with speed in the data: no velocities near vs among those from "
          "{:.2g} to {:.2g} m/s, or the noise hides it",
          traits.slowest_m_per_s, traits.fastest_m_per_s);
    case Quantity::stribeck_velocity:
    case Quantity::exponent:
      return solution.point[Quantity::excess] > 0.0 ? "too few velocities near vs in the data"
                                                    : "it has no effect while Fs is Fc";
    case Quantity::viscous:
      return fmt::format("not to be told from 0 at speeds up to {:.2g} m/s",
                         traits.fastest_m_per_s);
    case Quantity::stiffness:
      return why_no_stiffness(solution, record, traits);
    case Quantity::damping:
      return !solution.point.is_free(Quantity::stiffness)
                 ? "it shows only in presliding, of which the data tell nothing"
                 : "not to be told from 0: it shows only where the motion is fast in presliding";
    default:
      return "the model does not fit these data";
  }
}

// Static friction is the sum of two quantities; the errors of logarithms are relative ones.
double static_error(const Solution& solution) {
  const std::vector<Quantity> free = solution.point.free_quantities();
  const double level = solution.point[Quantity::coulomb] + solution.point[Quantity::excess];
  const auto share = [&](Eigen::Index i) {
    const Quantity q = free[static_cast<std::size_t>(i)];
    const bool is_part = q == Quantity::coulomb || q == Quantity::excess;
    return is_part ? solution.point[q] / level : 0.0;
  };
  const Eigen::MatrixXd& covariance = solution.squares.covariance;
  double variance = 0.0;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      variance += share(i) * covariance(i, j) * share(j);
    }
  }
  return std::sqrt(std::max(variance, 0.0));
}

FittedParameter described(Quantity quantity, const Solution& solution, bool was_searched,
                          const FrictionRecord& record, const RecordTraits& traits) {
  const bool is_static = quantity == Quantity::excess;
  FittedParameter result{.symbol = symbol_of(quantity), .value = solution.point[quantity]};
  if (is_static) {
    result.value += solution.point[Quantity::coulomb];
  }
  const double error = is_static ? static_error(solution) : error_of(solution, quantity);
  if (!was_searched) {
    result.knowledge = Knowledge::held;
  } else if (!solution.point.is_free(quantity) || !(error < kUnknownFrom)) {
    result.knowledge = Knowledge::unknown;
    result.why_unknown = why_unknown(quantity, solution, record, traits);
  } else {
    result.low = result.value * std::exp(-kTwoSided95 * error);
    result.high = result.value * std::exp(kTwoSided95 * error);
  }
  return result;
}

FrictionFit report_of(const Solution& solution, const FitPoint& start, const FrictionRecord& record,
                      const RecordTraits& traits) {
  FrictionFit fit{.friction = solution.point.friction(),
                  .has_converged = solution.squares.has_converged};
  constexpr std::array kInOrder{
      Quantity::coulomb,  Quantity::excess,    Quantity::viscous, Quantity::stribeck_velocity,
      Quantity::exponent, Quantity::stiffness, Quantity::damping};
  const bool falls = start.is_free(Quantity::excess);
  for (const Quantity q : kInOrder) {
    if (start.is_free(q) || (q == Quantity::exponent && falls)) {
      fit.parameters.push_back(described(q, solution, start.is_free(q), record, traits));
    }
  }
  const auto rows = static_cast<double>(record.rows() - 1);
  const auto count = static_cast<double>(solution.point.free_quantities().size());
  const double mean_square =
      std::max(solution.squares.sum_of_squares / rows, std::numeric_limits<double>::min());
  fit.residual_N = std::sqrt(mean_square);
  fit.aic = rows * std::log(mean_square) + 2.0 * (count + 1.0);
  Eigen::VectorXd forces;
  model_forces(solution.point, record, forces);
  fit.force_N.push_back(record.force_N.front());
  fit.force_N.insert(fit.force_N.end(), forces.begin(), forces.end());
  return fit;
}

}  // namespace

const FittedParameter& FrictionFit::parameter(std::string_view symbol) const {
  return *std::ranges::find(parameters, symbol, &FittedParameter::symbol);
}

FrictionFit fit_friction(const FrictionRecord& record, FrictionKind kind,
                         const FitOptions& options) {
  const RecordTraits traits = traits_of(record);
  const FitPoint start = start_of(record, traits, kind, options);
  Solution solution = best_solution(start, record);
  if (start.is_free(Quantity::stiffness) && !shows_presliding(traits)) {
    FitPoint without = solution.point;
    take_out(without, Quantity::stiffness);
    solution = solve(without, record, kWholeSearch);
  }
  while (const std::optional<Quantity> unknown = least_known(solution)) {
    FitPoint without = solution.point;
    take_out(without, *unknown);
    solution = solve(without, record, kWholeSearch);
  }
  return report_of(solution, start, record, traits);
}

std::span<const FrictionKind> fitted_kinds() {
  return kFittedKinds;
}

std::size_t preferred(std::span<const FrictionFit> fits) {
  constexpr double kSaysNothing = 2.0;
  const double least = std::ranges::min_element(fits, {}, &FrictionFit::aic)->aic;
  const auto first = std::ranges::find_if(
      fits, [=](const FrictionFit& fit) { return fit.aic <= least + kSaysNothing; });
  return static_cast<std::size_t>(first - fits.begin());
}

}  // namespace tactus::host
