// How full a CAN bus is: the frames of all its drives at the controller's rate, with as many stuff
// bits as a frame can have.
#pragma once

#include <cstddef>

#include "firmware/device/device_config.h"

namespace tactus::firmware {

// Above it a tick's frames may not get through in their tick.
inline constexpr double kMaxBusLoad = 0.9;

// Of what the bus can carry: 0 to 1, or more where it cannot. `connection` is an index into
// config.connections; 0 for one that is no CAN bus.
double bus_load(const DeviceConfig& config, std::size_t connection);

}  // namespace tactus::firmware
