// Computes the load of a CAN bus from the frames of all its drives at the controller's rate. Each
// frame has as many stuff bits as possible.
#pragma once

#include <cstddef>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Above this load the frames of a tick may not get through in their tick.
inline constexpr double kMaxBusLoad = 0.9;

// Returns the load of the bus as a share of its capacity; above 1 it cannot carry the frames.
// `connection` is an index into config.connections. Returns 0 for one that is no CAN bus.
double bus_load(const DeviceConfig& config, std::size_t connection);

}  // namespace tactus::firmware
