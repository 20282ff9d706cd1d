// Gives a controller its configuration, or tells the user which part of that is at fault.
#pragma once

#include <sstream>

#include "firmware/control/controller.h"
#include "host_tools/input_error.h"

namespace tactus::host {

// Throws InputError where the controller refuses it.
inline void configure(firmware::Controller& controller, const firmware::ControllerConfig& config) {
  if (const auto configured = controller.configure(config); !configured) {
    const firmware::ConfigError& error = configured.error();
    std::ostringstream text;
    text << "the controller refuses the configuration: " << error.field << " is " << error.value
         << ", not in " << error.least << " to " << error.greatest;
    throw InputError(text.str());
  }
}

}  // namespace tactus::host
