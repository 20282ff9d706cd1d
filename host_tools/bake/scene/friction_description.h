// Reads how the surface of an [[object]] rubs: its keys `friction` and `grain`. Part of reading
// scene.toml.
#pragma once

#include <string_view>
#include <vector>

#include "host_tools/bake/toml/toml_section.h"
#include "host_tools/friction/parameter_names.h"
#include "rendering/friction/friction_model.h"
#include "rendering/material/material.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Returns the parameters that a model has on a surface; their keys in TOML are `surface_key`. A
// cone has no stiffness there: it sticks by the surface's own.
std::vector<FrictionParameterName> surface_parameters(rendering::FrictionKind kind);

// Reads the key `friction` of an object; without it the surface has no friction.
// `contact_stiffness_N_per_m` is the object's: it is the default for a model with
// bristles. Throws InputError with the file and the line.
rendering::FrictionParameters read_friction(const TomlSection& object, std::string_view file,
                                            double contact_stiffness_N_per_m);

// Reads the key `grain`, by which friction differs with the direction; without it friction is alike
// in all directions. Throws InputError with the file and the line.
rendering::MaterialGrain read_grain(const TomlSection& object, std::string_view file,
                                    rendering::ContactMethod contact);

}  // namespace tactus::host
