#include "host_tools/friction/fit_start.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tactus::host {
namespace {

// The medians of the rows in a range of speeds. The weight is the square root of their number.
struct Bin {
  double speed_m_per_s = 0.0;
  double level = 0.0;
  double weight = 0.0;
};

// Returns the middle value (the upper of two); changes the order. `values` must not be empty.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Sorts rows into bins of speed, even in its logarithm. Only rows whose force opposes the motion
// with at least half its typical size count: in the others the force is still building up.
std::vector<Bin> bins_of(const FrictionRecord& record, const RecordTraits& traits) {
  constexpr std::size_t kBins = 40;
  constexpr double kHalf = 0.5;
  constexpr double kLeastRatio = 1e-6;
  const double bottom =
      std::log(std::max(traits.slowest_m_per_s, kLeastRatio * traits.fastest_m_per_s));
  const double width =
      std::max(std::log(traits.fastest_m_per_s) - bottom, 1e-3) / static_cast<double>(kBins);
  std::vector<std::vector<double>> speeds(kBins);
  std::vector<std::vector<double>> levels(kBins);
  for (std::size_t k = 1; k < record.rows(); ++k) {
    const double speed = record.speed_m_per_s(k);
    if (speed > 0.0 && record.level(k) > kHalf * traits.typical_level) {
      const double place = std::max(0.0, (std::log(speed) - bottom) / width);
      const auto bin = std::min(static_cast<std::size_t>(place), kBins - 1);
      speeds[bin].push_back(speed);
      levels[bin].push_back(record.level(k));
    }
  }
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < kBins; ++i) {
    if (!speeds[i].empty()) {
      const double weight = std::sqrt(static_cast<double>(speeds[i].size()));
      bins.push_back({median(speeds[i]), median(levels[i]), weight});
    }
  }
  return bins;
}

// A curve and how well it passes through the bins.
struct LinearCurve {
  SteadyCurve curve;
  double sum_of_squares = std::numeric_limits<double>::infinity();
};

// Returns the best curve for a given vs: in the other parameters the problem is linear.
LinearCurve through(const std::vector<Bin>& bins, double vs_m_per_s, bool falls) {
  const Eigen::Index columns = falls ? 3 : 2;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(bins.size()), columns);
  Eigen::VectorXd right(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Bin& bin = bins[static_cast<std::size_t>(i)];
    matrix(i, 0) = bin.weight;
    matrix(i, 1) = bin.weight * bin.speed_m_per_s;
    if (falls) {
      matrix(i, 2) = bin.weight * std::exp(-std::pow(bin.speed_m_per_s / vs_m_per_s, 2));
    }
    right(i) = bin.weight * bin.level;
  }
  const Eigen::VectorXd x = matrix.colPivHouseholderQr().solve(right);
  return {.curve = {.coulomb = x(0),
                    .excess = falls ? x(2) : 0.0,
                    .stribeck_velocity_m_per_s = vs_m_per_s,
                    .viscous_s_per_m = x(1)},
          .sum_of_squares = (matrix * x - right).squaredNorm()};
}

}  // namespace

SteadyCurve steady_curve(const FrictionRecord& record, const RecordTraits& traits, bool falls) {
  // Values of vs that are tried, even in the logarithm.
  constexpr int kTries = 40;
  // Below this share of the friction a search has no slope to follow.
  constexpr double kLeastShare = 0.02;
  const std::vector<Bin> bins = bins_of(record, traits);
  LinearCurve best{.curve = {.coulomb = traits.typical_level,
                             .stribeck_velocity_m_per_s = traits.slowest_m_per_s}};
  const double lowest =
      std::log(bins.empty() ? traits.slowest_m_per_s : bins.front().speed_m_per_s);
  const double highest = std::log(traits.fastest_m_per_s);
  for (int i = 0; i < (falls ? kTries : 1) && bins.size() > 3; ++i) {
    const double share = (i + 1.0) / (kTries + 1.0);
    const LinearCurve now = through(bins, std::exp(std::lerp(lowest, highest, share)), falls);
    const bool is_possible = now.curve.coulomb > 0.0 && (!falls || now.curve.excess > 0.0);
    if (is_possible && now.sum_of_squares < best.sum_of_squares) {
      best = now;
    }
  }
  SteadyCurve curve = best.curve;
  const double least = kLeastShare * traits.typical_level;
  curve.coulomb = std::max(curve.coulomb, least);
  curve.excess = std::max(curve.excess, falls ? least : 0.0);
  curve.viscous_s_per_m = std::max(curve.viscous_s_per_m, least / traits.fastest_m_per_s);
  return curve;
}

}  // namespace tactus::host
