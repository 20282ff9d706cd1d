// Nonlinear least squares with Eigen's Levenberg-Marquardt method, and the errors of the solution.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace tactus::host {

// Writes the residuals that belong to the parameters into `out`.
using Residuals = std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& out)>;

// When a search ends.
struct SearchLimits {
  // Evaluations of all residuals; those for derivatives are not counted.
  int most_evaluations = 100;
  // Relative change of the sum of squares and of the parameters.
  double tolerance = 1e-9;
};

// The result of a search.
struct LeastSquares {
  // The parameters at which the search ended.
  Eigen::VectorXd parameters;
  // Infinite or huge where the residuals do not depend on a parameter.
  Eigen::VectorXd standard_errors;
  Eigen::MatrixXd covariance;
  double sum_of_squares = 0.0;
  // False if it ended at the limit of evaluations.
  bool has_converged = false;
};

// Searches from `start`; `count` is the number of residuals. Parameters should be of the size 1, as
// logarithms are, since derivatives are differences over 1e-5.
LeastSquares least_squares(const Residuals& residuals, Eigen::Index count,
                           const Eigen::VectorXd& start, const SearchLimits& limits);

}  // namespace tactus::host
