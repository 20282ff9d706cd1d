// Saves a configuration as bytes, so that a recording can be replayed on any machine. Any thread;
// not real time.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

// The largest size of a saved configuration.
inline constexpr std::size_t kMaxConfigBytes = 4096;

// Writes the configuration to `room`. The certificate is left out, because a recorded run has
// passed it. Returns the number of bytes, or 0 if a number is not finite.
std::size_t save_config(const ControllerConfig& config, std::span<std::byte, kMaxConfigBytes> room);

// Reads a configuration. Returns false, and the defaults in `config`, if the bytes are not a
// configuration of this version. It does not check ranges; configure() does.
bool read_config(std::span<const std::byte> bytes, ControllerConfig& config);

}  // namespace tactus::firmware
