// Turns the sign check off for tests that make up a device's samples: its joints cannot answer a
// push, so none is asked for.
#pragma once

#include "firmware/configuration/controller_config.h"

namespace tactus::testing {

inline firmware::ControllerConfig without_sign_check(firmware::ControllerConfig config) {
  config.safety.sign_check_N = 0.0;
  return config;
}

}  // namespace tactus::testing
