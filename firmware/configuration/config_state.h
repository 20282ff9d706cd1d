// A configuration as bytes, for a recording that is replayed on another day and another machine.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

// Every configuration fits.
inline constexpr std::size_t kMaxConfigBytes = 4096;

// Without the certificate, which a run that was recorded has passed. How many bytes; 0 if a number
// is not finite.
std::size_t save_config(const ControllerConfig& config, std::span<std::byte, kMaxConfigBytes> room);

// False, and the defaults, if the bytes are of no configuration of this version. What they say is
// for configure() to check.
bool read_config(std::span<const std::byte> bytes, ControllerConfig& config);

}  // namespace tactus::firmware
