// Checks that a line of a GPIO chip is used once, and a gpio connection by one axis.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

struct UsedPin {
  std::string_view key;
  std::optional<std::uint32_t> offset;
};

std::array<UsedPin, 11> pins_of(const drivers::AxisPins& pins) {
  const auto used = [](std::string_view key, const auto& pin) {
    return UsedPin{key, pin ? std::optional(pin->offset) : std::nullopt};
  };
  return {{used("encoder_a", pins.encoder_a), used("encoder_b", pins.encoder_b),
           used("encoder_index", pins.encoder_index), used("fault", pins.fault),
           used("emergency_stop", pins.emergency_stop), used("limit_low", pins.limit_low),
           used("limit_high", pins.limit_high), used("direction", pins.direction),
           used("enable", pins.enable), used("brake_release", pins.brake_release),
           used("heartbeat", pins.heartbeat)}};
}

// Returns the key of the first pin of `pins` that uses the line `offset`, or an empty text.
std::string_view key_at(std::span<const UsedPin> pins, std::uint32_t offset) {
  const auto found = std::ranges::find(pins, std::optional(offset), &UsedPin::offset);
  return found == pins.end() ? std::string_view{} : found->key;
}

const drivers::GpioAxisConfig* gpio_axis(const AxisConfig& axis) {
  return std::get_if<drivers::GpioAxisConfig>(&axis.drive);
}

std::string_view chip_of(const DeviceConfig& device, const AxisConfig& axis) {
  return std::get<GpioConnection>(device.connections[axis.connection].line).chip;
}

std::unexpected<Refusal> refuse_pin(std::size_t axis, std::string_view key, Words& words) {
  words.add("; give each a line of its own");
  return std::unexpected(Refusal{Place::axis, axis, key, words.view()});
}

// Checks pin `p` of axis i, which uses the line `offset`, against the pins before it and those of
// earlier axes on the same chip.
Verdict check_pin(const DeviceConfig& device, std::size_t i, std::size_t p, std::uint32_t offset,
                  Words& words) {
  const AxisConfig& axis = device.axes[i];
  const auto pins = pins_of(gpio_axis(axis)->pins);
  words.clear();
  words.add("is line ").add(offset).add(", which is also ");
  if (const auto key = key_at(std::span(pins).first(p), offset); !key.empty()) {
    words.add(key);
    return refuse_pin(i, pins[p].key, words);
  }
  for (const AxisConfig& other : std::span(device.axes).first(i)) {
    if (gpio_axis(other) == nullptr || chip_of(device, other) != chip_of(device, axis)) {
      continue;
    }
    const auto taken = pins_of(gpio_axis(other)->pins);
    if (const auto key = key_at(taken, offset); !key.empty()) {
      words.add(key).add(" of axis \"").add(other.name).add("\"");
      return refuse_pin(i, pins[p].key, words);
    }
  }
  if (device.watchdog_line && device.watchdog_line->offset == offset &&
      device.watchdog_chip == chip_of(device, axis)) {
    words.add("the device's watchdog_line");
    return refuse_pin(i, pins[p].key, words);
  }
  return {};
}

Verdict check_axis_pins(const DeviceConfig& device, std::size_t i, Words& words) {
  const auto pins = pins_of(gpio_axis(device.axes[i])->pins);
  for (std::size_t p = 0; p < pins.size(); ++p) {
    if (const std::optional<std::uint32_t> offset = pins[p].offset) {
      if (const Verdict verdict = check_pin(device, i, p, *offset, words); !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

}  // namespace

// Two axes on one gpio connection are refused: they would share its PWM channel.
Verdict check_pins(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    const AxisConfig& axis = device.axes[i];
    if (gpio_axis(axis) == nullptr) {
      continue;
    }
    for (const AxisConfig& other : std::span(device.axes).first(i)) {
      if (other.connection == axis.connection) {
        words.clear();
        words.add("is also that of axis \"")
            .add(other.name)
            .add("\"; a gpio connection carries one axis: give each its own");
        return std::unexpected(Refusal{Place::axis, i, "connection", words.view()});
      }
    }
    if (const Verdict verdict = check_axis_pins(device, i, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
