// The start of a fit: values of the right size, read off the record without a search.
#pragma once

#include "host_tools/friction/fit_record.h"

namespace tactus::host {

// The steady friction over velocity, as shares of the normal force.
struct SteadyCurve {
  // The level of a fast slip.
  double coulomb = 0.0;
  // The excess of static friction over `coulomb`.
  double excess = 0.0;
  double stribeck_velocity_m_per_s = 0.0;
  double viscous_s_per_m = 0.0;
};

// Returns the curve Fc + excess exp(-(v/vs)^2) + sigma2 v through the medians of the force in bins
// of the velocity, for the best of many vs; without the excess if `falls` is false. All values are
// above 0, by a little where the medians give 0 or less.
SteadyCurve steady_curve(const FrictionRecord& record, const RecordTraits& traits, bool falls);

}  // namespace tactus::host
