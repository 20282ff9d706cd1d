// The lines of an axis at their chip, requested together, and read and set by their purpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/gpio_axis/axis_wiring.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "hal/gpio_lines.h"

namespace tactus::drivers {

// The levels of the inputs at one time.
class AxisLevels {
 public:
  // `active` is a mask of the request. The wiring must outlive the object.
  AxisLevels(const AxisWiring& wiring, std::uint64_t active) : wiring_(&wiring), active_(active) {}

  // Returns false for a line that is not connected.
  [[nodiscard]] bool is_active(AxisLine line) const { return (active_ & wiring_->bit(line)) != 0; }

 private:
  const AxisWiring* wiring_;
  std::uint64_t active_;
};

// Real time: all but `request`.
class AxisLines {
 public:
  // The chip must outlive the object. Nobody else requests its lines.
  AxisLines(const GpioAxisConfig& config, hal::GpioLines& chip) : wiring_(config), chip_(&chip) {}

  // Releases the lines and requests them anew, with outputs inactive.
  hal::Result<void> request(std::size_t edge_buffer);

  [[nodiscard]] bool is_connected(AxisLine line) const { return wiring_.bit(line) != 0; }
  [[nodiscard]] bool has_inputs() const { return wiring_.inputs() != 0; }
  // Returns true if any line is watched for edges.
  [[nodiscard]] bool watches_edges() const { return wiring_.watches_edges(); }

  hal::Result<AxisLevels> levels();
  // Reads the waiting edges, without waiting for more. Returns their number, or the error `timeout`
  // if there are none.
  hal::Result<std::size_t> read_edges(std::span<hal::GpioEdgeEvent> events) {
    return chip_->read_edges(events, hal::kNoWait);
  }
  // Takes an edge that was read. Returns how many edges are missing before it.
  std::uint32_t note(const hal::GpioEdgeEvent& event) { return loss_.saw(event); }
  // Returns the line of an edge, or nothing if it was not requested.
  [[nodiscard]] std::optional<AxisLine> line_of(const hal::GpioEdgeEvent& event) const {
    return wiring_.line_at(event.offset);
  }
  // Returns the number of missing edges since the request.
  [[nodiscard]] std::uint64_t edges_lost() const { return loss_.lost(); }

  // Sets an output. A line that is not connected stays as it is.
  hal::Result<void> set(AxisLine line, bool active);
  // Switches the bridge off, closes the brake and ends the heartbeat, with one call.
  hal::Result<void> switch_off();

 private:
  hal::Result<void> set(std::uint64_t mask, bool active);

  AxisWiring wiring_;
  hal::GpioLines* chip_;
  hal::GpioLossCounter loss_;
};

}  // namespace tactus::drivers
