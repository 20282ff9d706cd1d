// Checks the ranges of a mechanism's dimensions and weights. Any thread; not real time.
#pragma once

#include "firmware/configuration/range_check.h"

namespace tactus::firmware {

// Checks all fields of the geometry. An error names the field as in the geometry's struct, after
// "mechanism.".
void check_mechanism(RangeCheck& check, const MechanismGeometry& mechanism);

}  // namespace tactus::firmware
