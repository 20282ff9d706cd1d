#include "firmware/device_file/bus_load.h"

#include <span>

#include "firmware/device_file/axis_visit.h"

namespace tactus::firmware {

double bus_load(const DeviceConfig& config, std::size_t connection) {
  double load = 0.0;
  for (const AxisConfig& axis : std::span(config.axes).first(config.axis_count)) {
    if (axis.connection != connection) {
      continue;
    }
    load += visit_axis(config, axis, [&](const auto& driver, const auto& drive, const auto& bus) {
      return driver.can.load == nullptr ? 0.0
                                        : driver.can.load(drive, bus, config.controller.rate_hz);
    });
  }
  return load;
}

}  // namespace tactus::firmware
