// The mass, the centre of mass and the inertia of primitives, in closed form.
#pragma once

#include "host_tools/bake/body/mass_properties.h"
#include "rendering/surface/primitive.h"

namespace tactus::host {

// Returns the properties of a solid primitive in its own frame O; its pose is not used. Throws
// InputError, without a file name, for a density that is not above 0, and for a primitive without a
// volume: a plane, a dimension that is not above 0, and a primitive that has no closed form here.
MassProperties primitive_mass_properties(const rendering::Primitive& primitive,
                                         double density_kg_per_m3);

}  // namespace tactus::host
