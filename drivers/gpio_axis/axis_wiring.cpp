#include "drivers/gpio_axis/axis_wiring.h"

namespace tactus::drivers {

AxisWiring::AxisWiring(const GpioAxisConfig& config) {
  constexpr auto kBoth = hal::GpioEdges::both;
  constexpr auto kNone = hal::GpioEdges::none;
  const AxisPins& pins = config.pins;
  add(AxisLine::encoder_a, pins.encoder_a, kBoth, 0);
  add(AxisLine::encoder_b, pins.encoder_b, kBoth, 0);
  add(AxisLine::encoder_index, pins.encoder_index, kBoth, 0);
  add(AxisLine::fault, pins.fault, kBoth, 0);
  add(AxisLine::emergency_stop, pins.emergency_stop, kBoth, 0);
  add(AxisLine::limit_low, pins.limit_low, kNone, config.limit_debounce_us);
  add(AxisLine::limit_high, pins.limit_high, kNone, config.limit_debounce_us);
  add(AxisLine::direction, pins.direction);
  add(AxisLine::enable, pins.enable);
  add(AxisLine::brake_release, pins.brake_release);
  add(AxisLine::heartbeat, pins.heartbeat);
}

void AxisWiring::add(AxisLine line, const std::optional<InputPin>& pin, hal::GpioEdges edges,
                     std::uint32_t debounce_us) {
  if (!pin) {
    return;
  }
  append(line, {.offset = pin->offset,
                .direction = hal::GpioDirection::input,
                .bias = pin->bias,
                .active_low = pin->active_low,
                .edges = edges,
                .debounce_us = debounce_us});
  inputs_ |= bit(line);
  watches_edges_ = watches_edges_ || edges != hal::GpioEdges::none;
}

void AxisWiring::add(AxisLine line, const std::optional<OutputPin>& pin) {
  if (pin) {
    append(line, {.offset = pin->offset,
                  .direction = hal::GpioDirection::output,
                  .active_low = pin->active_low,
                  .drive = pin->drive});
  }
}

void AxisWiring::append(AxisLine line, const hal::GpioLineConfig& config) {
  lines_[count_] = config;
  names_[count_] = line;
  bits_[static_cast<std::size_t>(line)] = std::uint64_t{1} << count_;
  ++count_;
}

std::optional<AxisLine> AxisWiring::line_at(std::uint32_t offset) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (lines_[i].offset == offset) {
      return names_[i];
    }
  }
  return std::nullopt;
}

}  // namespace tactus::drivers
