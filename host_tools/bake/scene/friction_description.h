// The part of an [[object]] that says how its surface rubs: its keys friction and grain.
#pragma once

#include <string_view>
#include <vector>

#include "host_tools/bake/toml/toml_section.h"
#include "host_tools/friction/parameter_names.h"
#include "rendering/friction/friction_model.h"
#include "rendering/material/material.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The friction parameters of a surface whose TOML does not give them.
inline constexpr rendering::FrictionParameters kSurfaceFriction{
    .stribeck_velocity_m_per_s = 0.01,
    .stribeck_exponent = 2.0,
    .stick_velocity_m_per_s = 0.005,
    .elastic_fraction = 0.7,
};

// The parameters that a model has on a surface, with their keys in TOML: surface_key.
std::vector<FrictionParameterName> surface_parameters(rendering::FrictionKind kind);

// Reads the key `friction` of an object; without it the surface has no friction.
// `contact_stiffness_N_per_m` is the object's: it is the default for the bristles of dahl, lugre
// and elasto_plastic. Throws InputError with the file and the line.
rendering::FrictionParameters read_friction(const TomlSection& object, std::string_view file,
                                            double contact_stiffness_N_per_m);

// Reads the directions of the friction; without the key it is the same in all directions. Throws
// InputError with the file and the line.
rendering::MaterialGrain read_grain(const TomlSection& object, std::string_view file,
                                    rendering::ContactMethod contact);

}  // namespace tactus::host
