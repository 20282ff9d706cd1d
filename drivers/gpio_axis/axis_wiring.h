// Maps the lines of an axis to one request of the chip and to the bits of its masks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/gpio_axis/gpio_axis_config.h"
#include "hal/gpio_lines.h"

namespace tactus::drivers {

enum class AxisLine : std::uint8_t {
  encoder_a,
  encoder_b,
  encoder_index,
  fault,
  emergency_stop,
  limit_low,
  limit_high,
  direction,
  enable,
  brake_release,
  heartbeat,
};
inline constexpr std::size_t kAxisLines = 11;

// The lines that are connected. Outputs begin inactive: direction forward, bridge off, brake
// closed.
class AxisWiring {
 public:
  AxisWiring() = default;
  explicit AxisWiring(const GpioAxisConfig& config);

  [[nodiscard]] std::span<const hal::GpioLineConfig> lines() const {
    return {lines_.data(), count_};
  }
  // Returns the line's bit in a mask of the request, or 0 if it is not connected.
  [[nodiscard]] std::uint64_t bit(AxisLine line) const {
    return bits_[static_cast<std::size_t>(line)];
  }
  // Returns the mask of all inputs.
  [[nodiscard]] std::uint64_t inputs() const { return inputs_; }
  // Returns true if any line is watched for edges.
  [[nodiscard]] bool watches_edges() const { return watches_edges_; }
  // Returns the line at an offset of the chip, or nothing if it was not requested.
  [[nodiscard]] std::optional<AxisLine> line_at(std::uint32_t offset) const;

 private:
  void add(AxisLine line, const std::optional<InputPin>& pin, hal::GpioEdges edges,
           std::uint32_t debounce_us);
  void add(AxisLine line, const std::optional<OutputPin>& pin);
  void append(AxisLine line, const hal::GpioLineConfig& config);

  std::array<hal::GpioLineConfig, kAxisLines> lines_{};
  std::array<AxisLine, kAxisLines> names_{};
  std::array<std::uint64_t, kAxisLines> bits_{};
  std::size_t count_ = 0;
  std::uint64_t inputs_ = 0;
  bool watches_edges_ = false;
};

}  // namespace tactus::drivers
