// The registration of axes that are wired to a board, and of the board's pins as their connection.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/registration.h"

namespace tactus::drivers {

// The pins, the PWM channel and the counter of one axis on a board.
struct GpioConnection {
  std::string_view chip;        // the GPIO chip's label, or its path
  std::string_view pwm_folder;  // "/sys/class/pwm/pwmchip0"
  std::uint32_t pwm_channel = 0;
  // The name of a hardware counter that replaces encoder edges, in /sys/bus/counter/devices; empty
  // without one.
  std::string_view counter;  // "counter0"
  std::uint32_t counter_channel = 0;
};

namespace gpio {

std::span<const Binding<GpioConnection>> connection_keys();
Checked check(const GpioConnection& connection);
std::string_view shared_key(const GpioConnection& one, const GpioConnection& other);

std::span<const Binding<GpioAxisConfig>> keys();
bool has_index(const GpioAxisConfig& config);
std::string_view reference_advice(const GpioAxisConfig& config);
UsedLines lines(const GpioAxisConfig& config);

}  // namespace gpio

inline constexpr ConnectionRegistration<GpioConnection> kGpioConnection{
    .kind = "gpio",
    .keys = gpio::connection_keys,
    .check = gpio::check,
    .shared_key = gpio::shared_key,
    .chip = [](const GpioConnection& connection) { return connection.chip; },
};

inline constexpr Registration<GpioAxisConfig, GpioConnection> kGpioAxisDriver{
    .name = "gpio_axis",
    .keys = gpio::keys,
    .check =
        [](const GpioAxisConfig& config, const GpioConnection& connection) {
          return check(config, !connection.counter.empty());
        },
    .counts_per_turn =
        [](const GpioAxisConfig& config) {
          return static_cast<double>(config.encoder.counts_per_rev);
        },
    .has_index = gpio::has_index,
    .reference_advice = gpio::reference_advice,
    .has_heartbeat = [](const GpioAxisConfig& config) { return config.pins.heartbeat.has_value(); },
    .lines = gpio::lines,
};

}  // namespace tactus::drivers
