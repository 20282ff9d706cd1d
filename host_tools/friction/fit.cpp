#include "host_tools/friction/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "host_tools/friction/fit_knowledge.h"
#include "host_tools/friction/fit_search.h"
#include "host_tools/friction/fit_start.h"
#include "host_tools/friction/parameter_names.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionModelTraits;
using rendering::FrictionParameters;

// Returns true if the search knows all that the model has: a viscous term, no static level without
// Stribeck's curve from it, and no parameter of the model alone.
constexpr bool can_be_fitted(const FrictionModelTraits& model) {
  constexpr std::array kSearched{
      &FrictionParameters::coulomb,           &FrictionParameters::static_level,
      &FrictionParameters::viscous_s_per_m,   &FrictionParameters::stribeck_velocity_m_per_s,
      &FrictionParameters::stribeck_exponent, &FrictionParameters::stiffness_N_per_m,
      &FrictionParameters::damping_s_per_m,   &FrictionParameters::damping_fade_m_per_s};
  return model.has(&FrictionParameters::viscous_s_per_m) &&
         model.has(&FrictionParameters::static_level) ==
             model.has(&FrictionParameters::stribeck_velocity_m_per_s) &&
         std::ranges::all_of(model.parameters, [&](double FrictionParameters::* parameter) {
           return std::ranges::find(kSearched, parameter) != kSearched.end();
         });
}

// The 97.5 % quantile of the normal distribution: 95 % lie within it on both sides.
constexpr double kTwoSided95 = 1.96;

// Takes a quantity out of the search. It becomes 0 if the model works without it, else it keeps its
// value.
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

// Returns the fit without a fall of friction with speed, unless it is clearly worse. A curve that
// falls finds something to follow in any noise, and standard errors do not show it, since they hold
// for that place only.
Solution with_a_fall_that_is_there(Solution solution, const FrictionRecord& record,
                                   const RecordTraits& traits) {
  // The required gain in twice the logarithm of the likelihood.
  constexpr double kClearly = 12.0;
  if (!solution.point.is_free(Quantity::excess)) {
    return solution;
  }
  FitPoint without = solution.point;
  take_out(without, Quantity::excess);
  const SteadyCurve curve = steady_curve(record, traits, false);
  without.set(Quantity::coulomb, curve.coulomb);
  without.set(Quantity::viscous, curve.viscous_s_per_m);
  Solution other = solve(without, record);
  const double gain = static_cast<double>(record.rows()) *
                      std::log(other.squares.sum_of_squares / solution.squares.sum_of_squares);
  return gain < kClearly ? other : solution;
}

// Returns a point whose bristle is held so stiff that it cannot be seen. In a record that does not
// show presliding, a soft bristle could take the shape of anything.
FitPoint without_presliding(const FitPoint& start, const RecordTraits& traits) {
  FitPoint point = start;
  take_out(point, Quantity::stiffness);
  point.set(Quantity::stiffness, stiffest(start, traits));
  return point;
}

// Returns a parameter with its 95 % interval, or with why it has none. Intervals are those of the
// logarithm: value / f to value * f.
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
  } else if (!solution.point.is_free(quantity) || is_unknown(error)) {
    result.knowledge = Knowledge::unknown;
    result.why_unknown = why_unknown(quantity, solution, record, traits);
  } else {
    result.low = result.value * std::exp(-kTwoSided95 * error);
    result.high = result.value * std::exp(kTwoSided95 * error);
  }
  return result;
}

// Returns the result: parameters, forces, residual and Akaike's criterion, n ln(residual^2) + 2 (k
// + 1), which is smaller for the better model; k is the number of free quantities, and the noise is
// one more.
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
  Eigen::VectorXd forces;
  model_forces(solution.point, record, forces);
  fit.force_N.assign(forces.begin(), forces.end());
  // The first row has no tick before it and is no evidence.
  const auto rows = static_cast<double>(record.rows() - 1);
  const auto count = static_cast<double>(solution.point.free_quantities().size());
  const double sum = sum_of_squares(solution.point, record) -
                     std::pow(fit.force_N.front() - record.force_N.front(), 2);
  const double mean_square = std::max(sum / rows, std::numeric_limits<double>::min());
  fit.residual_N = std::sqrt(mean_square);
  fit.aic = rows * std::log(mean_square) + 2.0 * (count + 1.0);
  return fit;
}

}  // namespace

const FittedParameter& FrictionFit::parameter(std::string_view symbol) const {
  return *std::ranges::find(parameters, symbol, &FittedParameter::symbol);
}

FrictionFit fit_friction(const FrictionRecord& record, FrictionKind kind,
                         const FitOptions& options) {
  const RecordTraits traits = traits_of(record);
  const std::vector<FitPoint> starts = starts_of(record, traits, kind, options);
  const FitPoint& start = starts.front();
  const bool knows_bristles = !start.is_free(Quantity::stiffness) || shows_presliding(traits);
  Solution solution = knows_bristles ? best_solution(starts, record)
                                     : best_solution({{without_presliding(start, traits)}}, record);
  solution = with_a_fall_that_is_there(std::move(solution), record, traits);
  // Quantities that the data do not tell leave the search one by one, and the rest is solved anew.
  while (const std::optional<Quantity> unknown = least_known(solution)) {
    FitPoint without = solution.point;
    take_out(without, *unknown);
    solution = solve(without, record);
  }
  return report_of(solution, start, record, traits);
}

std::vector<FrictionKind> fitted_kinds() {
  std::vector<FrictionKind> kinds;
  for (const FrictionModelTraits& model : rendering::kFrictionModels) {
    if (can_be_fitted(model)) {
      kinds.push_back(model.kind);
    }
  }
  return kinds;
}

std::size_t preferred(std::span<const FrictionFit> fits) {
  // A difference of Akaike's criterion below 2 is no evidence (Burnham and Anderson, "Model
  // selection and multimodel inference", 2002).
  constexpr double kSaysNothing = 2.0;
  const double least = std::ranges::min_element(fits, {}, &FrictionFit::aic)->aic;
  const auto first = std::ranges::find_if(
      fits, [=](const FrictionFit& fit) { return fit.aic <= least + kSaysNothing; });
  return static_cast<std::size_t>(first - fits.begin());
}

}  // namespace tactus::host
