// Estimates the parameters of a friction model from a measured record. `tactus fit` calls it.
//
// The model runs over the record's displacements tick by tick, as the controller would run it, and
// its force is compared with the measured one. The method of Levenberg and Marquardt (Eigen)
// minimises the sum of squares. Parameters are searched by their logarithms, so that they stay
// positive, and Fs by its excess over Fc. The start is read off the record: medians of the force
// over velocity for the steady curve, and the best of many stiffnesses for presliding.
//
// A 95 % interval is plus and minus 1.96 standard errors of the logarithm, from the Jacobian and
// the residual, widened if neighbouring residuals are alike. A parameter whose standard error is
// half of its value or more cannot be told from the data: it is taken out, at 0 if the model
// permits, and the others are fitted anew. The same happens to a fall of friction with speed if the
// fit without it is not clearly worse.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/friction/fit_record.h"
#include "rendering/friction/friction_model.h"

namespace tactus::host {

// How a parameter's value was found.
enum class Knowledge {
  // The value fits the data best, and its interval is known.
  fitted,
  // Given by the caller and not fitted.
  held,
  // The data cannot tell it.
  unknown,
};

// One parameter of the result.
struct FittedParameter {
  // A symbol of parameter_names.h.
  std::string_view symbol;
  Knowledge knowledge = Knowledge::fitted;
  // The fitted value, or the value that the fit used if the parameter was not fitted.
  double value = 0.0;
  // The 95 % interval.
  double low = 0.0;
  double high = 0.0;
  // Why the data cannot tell it, for the user; empty otherwise.
  std::string why_unknown;
};

// The result of a fit.
struct FrictionFit {
  // The model with the fitted values.
  rendering::FrictionParameters friction;
  // In the order of parameter_names.h.
  std::vector<FittedParameter> parameters;
  // Root mean square of the difference of the forces.
  double residual_N = 0.0;
  // Akaike's information criterion: n log(sum of squares / n) + 2 (k + 1) with n rows and k fitted
  // numbers. Smaller is better.
  double aic = 0.0;
  // False if the search ended at its limit of evaluations.
  bool has_converged = false;
  // The model's force in each row of the record.
  std::vector<double> force_N;

  // Returns a parameter by its symbol, which must be among them.
  [[nodiscard]] const FittedParameter& parameter(std::string_view symbol) const;
};

// The quantities to fit beside the usual parameters.
struct FitOptions {
  // True: the Stribeck exponent alpha is fitted too, from `exponent` on; false: it is `exponent`.
  bool fits_exponent = false;
  double exponent = 2.0;
};

// Fits one model. `kind` must be one of fitted_kinds().
FrictionFit fit_friction(const FrictionRecord& record, rendering::FrictionKind kind,
                         const FitOptions& options = {});

// Returns the models that can be fitted, the simplest first.
std::vector<rendering::FrictionKind> fitted_kinds();

// Returns the index of the fit with the least AIC, or of the first one within 2 of it: such a
// difference says nothing, and earlier models are simpler.
std::size_t preferred(std::span<const FrictionFit> fits);

}  // namespace tactus::host
