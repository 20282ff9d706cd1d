// Visits an axis together with the registration of its driver and with its connection.
#pragma once

#include <variant>

#include "firmware/device_file/device_config.h"

namespace tactus::firmware {

// Returns action(registration of the driver, settings of the drive, settings of the connection).
// The connection is of the kind that the driver needs, as the reader has checked.
template <class Action>
decltype(auto) visit_axis(const DeviceConfig& device, const AxisConfig& axis, Action&& action) {
  return drivers::visit_drive(
      axis.drive, [&](const auto& driver, const auto& drive) -> decltype(auto) {
        using Connection = typename std::remove_cvref_t<decltype(driver)>::Connection;
        return action(driver, drive,
                      std::get<Connection>(device.connections[axis.connection].line));
      });
}

}  // namespace tactus::firmware
