// Checks the settings in which the drives of one kind on one bus must agree. Not real time.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <variant>

#include "firmware/device_file/device_config.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// Checks the drives of one kind, all of a bus, of at most kMaxTools devices. is_on(device,
// connection) returns true if the connection of that index is on the bus.
template <class Driver, class IsOn>
drivers::Checked check_drives_on_bus(const Driver& driver,
                                     std::span<const DeviceConfig* const> devices, IsOn is_on) {
  using Config = typename Driver::Config;
  if (driver.can.check_bus == nullptr) {
    return {};
  }
  std::array<Config, rendering::kMaxTools * kMaxAxes> drives{};
  std::size_t count = 0;
  for (const DeviceConfig* const device : devices) {
    for (const AxisConfig& axis : std::span(device->axes).first(device->axis_count)) {
      const auto* const drive = std::get_if<Config>(&axis.drive);
      if (drive != nullptr && is_on(*device, axis.connection)) {
        drives[count] = *drive;
        ++count;
      }
    }
  }
  return count == 0 ? drivers::Checked{} : driver.can.check_bus(std::span(drives).first(count));
}

// Checks the drives of every kind on the bus.
template <class IsOn>
drivers::Checked check_bus_settings(std::span<const DeviceConfig* const> devices, IsOn is_on) {
  drivers::Checked checked;
  const auto agree = [&](const auto& driver) {
    checked = check_drives_on_bus(driver, devices, is_on);
    return checked.has_value();
  };
  (void)std::apply([&](const auto&... drivers) { return (agree(drivers) && ...); },
                   drivers::kRegisteredDrivers);
  return checked;
}

}  // namespace tactus::firmware
