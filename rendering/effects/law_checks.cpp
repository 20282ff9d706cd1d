#include "rendering/effects/law_checks.h"

#include <cmath>

namespace tactus::rendering {

bool within(const NumberField& field, double value) {
  switch (field.range) {
    case FieldRange::above_zero:
      return std::isfinite(value) && value > 0.0;
    case FieldRange::zero_or_more:
      return std::isfinite(value) && value >= 0.0;
    default:
      return std::isfinite(value);
  }
}

bool within(const VectorField& field, const Vec3& value) {
  constexpr double kTolerance = 1e-9;
  if (field.use == VectorUse::direction) {
    return std::abs(value.squaredNorm() - 1.0) <= kTolerance;  // false for NaN
  }
  return value.allFinite();
}

bool within(const VolumeField& /*field*/, const Primitive& value) {
  return valid(value);
}

}  // namespace tactus::rendering
