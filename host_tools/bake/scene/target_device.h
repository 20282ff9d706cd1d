// The part of a scene that says on which device it is to be felt, for the checks of baking: its
// table [device]. Nothing of it goes into the image.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/toml/toml_section.h"
#include "rendering/friction/sampled_device.h"

namespace tactus::host {

struct TargetDevice {
  // A desktop device and the finger that holds it: 0.1 kg and 0.5 N s/m, the finger's 4 N s/m, and
  // one tick from the reading to the force, as host_tools/simulation has them.
  rendering::SampledDevice device{
      .mass_kg = 0.1, .damping_Ns_per_m = 4.5, .step_s = 1e-3, .delay_ticks = 1};
  double max_normal_force_N = 10.0;
};

// Reads the table of the scene's device; without it the result is the default. Throws InputError
// with the file and the line.
TargetDevice read_device(const TomlSection& scene, std::string_view file);

// "0.1 kg, 4.5 N s/m, 1000 Hz and a delay of 1 tick".
std::string in_words(const TargetDevice& description);

}  // namespace tactus::host
