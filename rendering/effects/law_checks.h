// Checks the fields of a law against their ranges.
#pragma once

#include "rendering/effects/law_fields.h"
#include "rendering/geometry/vector.h"
#include "rendering/surface/primitive.h"

namespace tactus::rendering {

// Returns true if the value is finite and within its field's range, a direction unit to 1e-9, and a
// volume valid().
bool within(const NumberField& field, double value);
bool within(const VectorField& field, const Vec3& value);
bool within(const VolumeField& field, const Primitive& value);

template <class Law>
bool valid_law(const Law& law) {
  bool good = true;
  const auto check = [&good](const auto& field, const auto& value) {
    good = good && within(field, value);
  };
  Law::visit_fields(law, check);
  return good;
}

}  // namespace tactus::rendering
