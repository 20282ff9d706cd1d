// Nonlinear least squares with Eigen's Levenberg-Marquardt, and what the solution is worth.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace tactus::host {

// Writes the residuals of the given parameters.
using Residuals = std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& out)>;

struct SearchLimits {
  int most_evaluations = 100;  // each of a whole set of residuals; derivatives are not counted
  double tolerance = 1e-9;     // relative, of the sum of squares and of the parameters
};

struct LeastSquares {
  Eigen::VectorXd parameters;
  Eigen::VectorXd standard_errors;  // infinite where the residuals do not depend on the parameter
  Eigen::MatrixXd covariance;
  double sum_of_squares = 0.0;
  bool has_converged = false;
};

// Parameters should be of the size 1, as logarithms are: derivatives are differences of 1e-5.
LeastSquares least_squares(const Residuals& residuals, Eigen::Index count,
                           const Eigen::VectorXd& start, const SearchLimits& limits);

}  // namespace tactus::host
