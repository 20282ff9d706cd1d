#include "host_tools/friction/least_squares.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace tactus::host {
namespace {

// The residuals and their derivatives, by central differences, in the form that Eigen asks for.
class Functor : public Eigen::DenseFunctor<double> {
 public:
  Functor(const Residuals& residuals, Eigen::Index inputs, Eigen::Index values)
      : DenseFunctor(static_cast<int>(inputs), static_cast<int>(values)), residuals_(residuals) {}

  int operator()(const InputType& parameters, ValueType& out) const {
    residuals_(parameters, out);
    return 0;
  }

  int df(const InputType& parameters, JacobianType& out) const {
    // Balances rounding and curvature: parameters are logarithms or scaled to 1.
    constexpr double kStep = 1e-5;
    InputType shifted = parameters;
    ValueType above(values());
    ValueType below(values());
    for (Eigen::Index j = 0; j < parameters.size(); ++j) {
      shifted(j) = parameters(j) + kStep;
      residuals_(shifted, above);
      shifted(j) = parameters(j) - kStep;
      residuals_(shifted, below);
      shifted(j) = parameters(j);
      out.col(j) = (above - below) / (2.0 * kStep);
    }
    return 0;
  }

 private:
  const Residuals& residuals_;
};

// Returns the factor by which errors are wider than for independent residuals. Neighbouring
// residuals are taken for an autoregressive process of first order with correlation r: sqrt((1 + r)
// / (1 - r)).
double widening(const Eigen::VectorXd& residuals) {
  constexpr double kMost = 0.99;
  const Eigen::Index n = residuals.size();
  const double all = residuals.squaredNorm();
  if (n < 3 || !(all > 0.0)) {
    return 1.0;
  }
  const double neighbours = residuals.head(n - 1).dot(residuals.tail(n - 1));
  const double correlation = std::clamp(neighbours / all, 0.0, kMost);
  return std::sqrt((1.0 + correlation) / (1.0 - correlation));
}

// Returns the inverse of J'J, by the eigenvectors of the matrix with its columns scaled to 1.
// Directions on which nothing depends get a huge variance instead of a division by zero.
Eigen::MatrixXd inverse_of_normal(const Eigen::MatrixXd& jacobian) {
  constexpr double kNothing = 1e-13;
  Eigen::VectorXd scale = jacobian.colwise().norm();
  const double floor = std::max(scale.maxCoeff() * kNothing, 1e-150);
  scale = scale.cwiseMax(floor);
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled.transpose() * scaled);
  const Eigen::VectorXd inverse = solver.eigenvalues().cwiseMax(kNothing).cwiseInverse();
  const Eigen::MatrixXd half = scale.cwiseInverse().asDiagonal() * solver.eigenvectors();
  return half * inverse.asDiagonal() * half.transpose();
}

}  // namespace

LeastSquares least_squares(const Residuals& residuals, Eigen::Index count,
                           const Eigen::VectorXd& start, const SearchLimits& limits) {
  LeastSquares result;
  result.parameters = start;
  Eigen::VectorXd values(count);
  if (start.size() > 0) {
    Functor functor(residuals, start.size(), count);
    Eigen::LevenbergMarquardt<Functor> solver(functor);
    solver.setMaxfev(limits.most_evaluations);
    solver.setFtol(limits.tolerance);
    solver.setXtol(limits.tolerance);
    solver.setFactor(1.0);
    const auto status = solver.minimize(result.parameters);
    result.has_converged =
        status > 0 && status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation;
    Eigen::MatrixXd jacobian(count, start.size());
    functor.df(result.parameters, jacobian);
    residuals(result.parameters, values);
    const double degrees = std::max<double>(1.0, static_cast<double>(count - start.size()));
    // The covariance s^2 (J'J)^-1 of independent residuals, widened for those that are not.
    const double factor = widening(values);
    result.covariance =
        factor * factor * values.squaredNorm() / degrees * inverse_of_normal(jacobian);
    result.standard_errors = result.covariance.diagonal().cwiseSqrt();
  } else {
    residuals(result.parameters, values);
    result.has_converged = true;
  }
  result.sum_of_squares = values.squaredNorm();
  return result;
}

}  // namespace tactus::host
