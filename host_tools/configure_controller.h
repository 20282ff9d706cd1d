// Gives a controller its configuration, or tells the user which entry of it is out of range.
// Simulation, replay and certify call it before the first tick; it never runs in the control loop.
#pragma once

#include <cstddef>
#include <sstream>

#include "firmware/control/controller.h"
#include "host_tools/input_error.h"

namespace tactus::host {

// Configures a device of `controller`, which starts anew in mode `init`. If it refuses, it keeps
// its old configuration, and this throws InputError that names the refused field, its value and the
// permitted range, in the units of ControllerConfig.
inline void configure(firmware::Controller& controller, const firmware::ControllerConfig& config,
                      std::size_t device = 0) {
  if (const auto configured = controller.configure(config, device); !configured) {
    const firmware::ConfigError& error = configured.error();
    std::ostringstream text;
    text << "the controller refuses the configuration: " << error.field << " is " << error.value
         << ", not in " << error.least << " to " << error.greatest;
    throw InputError(text.str());
  }
}

}  // namespace tactus::host
