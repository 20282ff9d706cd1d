// Reports the result of a fit in words, in TOML and as a figure.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/friction/fit.h"
#include "host_tools/friction/parameter_names.h"

namespace tactus::host {

ForceScale scale_of(const FrictionRecord& record);

// Returns one line that describes the record.
std::string record_text(const std::string& name, const FrictionRecord& record);

// Returns a warning if the record is too rough to compute a velocity from; else empty.
std::string record_warning(const FrictionRecord& record);

// The model, its residual and AIC, and a line a parameter: value, interval and unit, or why the
// data cannot tell.
std::string fit_text(const FrictionFit& fit, ForceScale scale, bool is_preferred);

enum class TomlUse { surface, joint };

// A table [object.friction] of a scene, or [joint.friction]. What the data cannot tell is 0 where
// the model goes without it, and left out where it does not; a comment says which and why.
std::string fit_toml(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
                     TomlUse use);

// Measured and fitted force over time, displacement and velocity. Throws InputError when gnuplot is
// missing or fails.
void draw_fit(const std::string& name, const FrictionFit& fit, const FrictionRecord& record,
              const std::filesystem::path& png);

}  // namespace tactus::host
