// Reports the result of a fit in words, in TOML and as a figure.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/friction/fit.h"
#include "host_tools/friction/parameter_names.h"

namespace tactus::host {

// Returns whether the record's parameters are forces or shares of the normal force.
ForceScale scale_of(const FrictionRecord& record);

// Returns one line that describes the record.
std::string record_text(const std::string& name, const FrictionRecord& record);

// Returns a warning if the record is too rough to compute a velocity from; else empty.
std::string record_warning(const FrictionRecord& record);

// Returns the model, its residual and AIC, and a line for each parameter: value, interval and unit,
// or why the data cannot tell it.
std::string fit_text(const FrictionFit& fit, ForceScale scale, bool is_preferred);

// The target of the parameters: the surface of a scene, or a joint of a device.
enum class TomlUse { surface, joint };

// Returns a table [object.friction] or [joint.friction]. A parameter that the data cannot tell is 0
// if the model works without it, and left out otherwise; a comment says why.
std::string fit_toml(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
                     TomlUse use);

// Draws measured and fitted force over time, displacement and velocity. Throws InputError if
// gnuplot is missing or fails.
void draw_fit(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
              const std::filesystem::path& picture);

}  // namespace tactus::host
