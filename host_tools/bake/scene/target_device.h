// Reads the table [device] of a scene: on which device it is to be felt. Only the checks of baking
// use it; nothing of it goes into the image.
#pragma once

#include <string>
#include <string_view>

#include "host_tools/bake/toml/toml_section.h"
#include "rendering/friction/sampled_device.h"

namespace tactus::host {

// The device with the finger that holds it.
struct TargetDevice {
  // The default is a desktop device, 0.1 kg with 0.5 N s/m, held by a finger of 4 N s/m, with a
  // delay of one tick from the reading to the force; host_tools/simulation has the same.
  rendering::SampledDevice device{
      .mass_kg = 0.1, .damping_Ns_per_m = 4.5, .step_s = 1e-3, .delay_ticks = 1};
  // The largest force with which the surface is pressed.
  double max_normal_force_N = 10.0;
};

// Reads the table; without one the result is the default. Throws InputError with the file and the
// line.
TargetDevice read_device(const TomlSection& scene, std::string_view file);

// Returns the device as text, such as "0.1 kg, 4.5 N s/m, 1000 Hz and a delay of 1 tick".
std::string in_words(const TargetDevice& description);

}  // namespace tactus::host
