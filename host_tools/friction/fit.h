// Estimating the parameters of a friction model from a measured record.
//
// The model is run over the record's displacements, tick by tick, as the controller would run it,
// and its force compared with the measured one; Levenberg and Marquardt's method (Eigen) makes the
// sum of the squares least. Parameters enter by their logarithms, so that they stay positive, and
// Fs by what it exceeds Fc by. It starts from what can be seen: the medians of the force over
// velocity for the steady curve, and the best of many stiffnesses for presliding.
//
// An interval of 95 % is plus and minus 1.96 standard errors of the logarithm, from the Jacobian
// and the residual, widened where neighbouring residuals are alike. A parameter whose standard
// error is half of itself or more is one that the data cannot tell: it is taken out, at 0 where
// that is possible, and the rest is fitted anew without it. So is a fall of the friction with speed
// without which the fit is not clearly worse.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/friction/fit_record.h"
#include "rendering/friction/friction_model.h"

namespace tactus::host {

enum class Knowledge {
  fitted,
  held,     // given, not fitted
  unknown,  // the data cannot tell
};

struct FittedParameter {
  std::string_view symbol;  // of parameter_names.h
  Knowledge knowledge = Knowledge::fitted;
  // The fitted value, or the value that the fit used if the parameter was not fitted.
  double value = 0.0;
  double low = 0.0;  // of the interval of 95 %
  double high = 0.0;
  std::string why_unknown;
};

struct FrictionFit {
  rendering::FrictionParameters friction;
  std::vector<FittedParameter> parameters;  // in the order of parameter_names.h
  double residual_N = 0.0;                  // root mean square
  // n log(sum of squares / n) + 2 (k + 1) with n rows and k fitted numbers; smaller is better.
  double aic = 0.0;
  bool has_converged = false;
  std::vector<double> force_N;  // the model's, a value a row

  [[nodiscard]] const FittedParameter& parameter(std::string_view symbol) const;
};

struct FitOptions {
  bool fits_exponent = false;  // alpha too; else it is `exponent`
  double exponent = 2.0;
};

// `kind` is one of fitted_kinds().
FrictionFit fit_friction(const FrictionRecord& record, rendering::FrictionKind kind,
                         const FitOptions& options = {});

// Returns the models that can be fitted, the simplest first.
std::vector<rendering::FrictionKind> fitted_kinds();

// The one with the least AIC; the first of those that are within 2 of it, which says nothing.
std::size_t preferred(std::span<const FrictionFit> fits);

}  // namespace tactus::host
