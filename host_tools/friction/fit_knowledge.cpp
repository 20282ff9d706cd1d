#include "host_tools/friction/fit_knowledge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tactus::host {
namespace {

// A parameter whose logarithm has this standard error or more is unknown: plus and minus two of
// them come down to almost nothing.
constexpr double kUnknownFrom = 0.5;

// A reversal must have this many rows of presliding. With fewer, the turn itself, which happens
// between two rows, decides what the model does in them.
constexpr std::size_t kPreslidingRows = 2;

// Returns the least stiffness that the data permit: where the sum of squares has risen by what
// chance raises it in one case of twenty. 0 if there is none.
double least_stiffness(const Solution& solution, const FrictionRecord& record) {
  // The 95 % quantile of the chi-squared distribution with one degree of freedom.
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

// Returns why the record does not tell the stiffness, for the user.
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

}  // namespace

double error_of(const Solution& solution, Quantity quantity) {
  const std::vector<Quantity> free = solution.point.free_quantities();
  const auto found = std::ranges::find(free, quantity);
  return found == free.end() ? 0.0 : solution.squares.standard_errors(found - free.begin());
}

// Errors of logarithms are relative ones, so each counts by its share.
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

bool is_unknown(double error) {
  return !(error < kUnknownFrom);
}

std::optional<Quantity> least_known(const Solution& solution) {
  if (is_unknown(error_of(solution, Quantity::excess))) {
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

}  // namespace tactus::host
