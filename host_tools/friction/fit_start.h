// The start of a fit: values of the right size, read from the record without a search.
#pragma once

#include "host_tools/friction/fit_record.h"

namespace tactus::host {

struct SteadyCurve {
  double coulomb = 0.0;
  double excess = 0.0;  // of static friction over it
  double stribeck_velocity_m_per_s = 0.0;
  double viscous_s_per_m = 0.0;
};

// Fc + excess exp(-(v/vs)^2) + sigma2 v through the medians of the force in bins of the velocity,
// for the best of many vs; `falls` false: without the excess. All are above 0, by a little where
// the medians say 0 or less.
SteadyCurve steady_curve(const FrictionRecord& record, const RecordTraits& traits, bool falls);

}  // namespace tactus::host
