#include "drivers/gpio_axis/axis_lines.h"

#include <expected>

namespace tactus::drivers {

hal::Result<void> AxisLines::request(std::size_t edge_buffer) {
  chip_->release();
  const auto requested = chip_->request({.lines = wiring_.lines(), .edge_buffer = edge_buffer});
  if (requested) {
    loss_ = {};
  }
  return requested;
}

hal::Result<AxisLevels> AxisLines::levels() {
  const auto active = chip_->get(wiring_.inputs());
  if (!active) {
    return std::unexpected(active.error());
  }
  return AxisLevels(wiring_, *active);
}

hal::Result<void> AxisLines::set(AxisLine line, bool active) {
  return set(wiring_.bit(line), active);
}

hal::Result<void> AxisLines::switch_off() {
  return set(wiring_.bit(AxisLine::enable) | wiring_.bit(AxisLine::brake_release) |
                 wiring_.bit(AxisLine::heartbeat),
             false);
}

hal::Result<void> AxisLines::set(std::uint64_t mask, bool active) {
  return mask == 0 ? hal::Result<void>{} : chip_->set(mask, active ? mask : 0);
}

}  // namespace tactus::drivers
