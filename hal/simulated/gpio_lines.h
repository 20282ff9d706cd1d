// A request of lines of a simulated GPIO chip. One thread; see simulated/clock.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/gpio_lines.h"
#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"
#include "hal/simulated/gpio_chip.h"

namespace tactus::hal {

// A request that a driver holds.
//
// Simulated: edges with times and sequence numbers in a bounded buffer that loses the oldest; the
// kernel's debouncing (an edge is reported when the level has been stable for the period, with that
// time); edges that the interrupt missed. Not simulated: a wrong `rising` after a loss, interrupt
// latency, the rounding of the debounce period to the kernel's timer tick.
class SimulatedGpioLines final : public GpioLines, private SimulatedEventSource {
 public:
  // The chip must outlive this.
  explicit SimulatedGpioLines(SimulatedGpioChip& chip);
  SimulatedGpioLines(const SimulatedGpioLines&) = delete;
  SimulatedGpioLines& operator=(const SimulatedGpioLines&) = delete;
  ~SimulatedGpioLines();

  // Causes a fault: the next `count` edges are numbered but never reported.
  void lose_next_edges(std::uint32_t count) { losing_ = count; }

  // Returns the number of edges that were not read yet.
  std::size_t edges_waiting() const { return edges_.size(); }

 private:
  friend class SimulatedGpioChip;

  // A line of the request.
  struct Line {
    GpioLineConfig config;
    // The debounced physical level.
    bool settled = false;
    // The time at which the debounced level takes over the pin's; kForever: nothing is pending.
    TimeNs settles_ns = kForever;
    // The number of the line's last edge.
    std::uint32_t sequence = 0;
  };

  Result<void> DoRequest(const GpioRequest& request) override;
  void DoRelease() override;
  Result<std::uint64_t> DoGet(std::uint64_t mask) override;
  Result<void> DoSet(std::uint64_t mask, std::uint64_t values) override;
  Result<std::size_t> DoReadEdges(std::span<GpioEdgeEvent> events, TimeNs deadline_ns) override;

  TimeNs next_event_ns() const override;
  void run_event() override;

  void claim(std::size_t index, const GpioLineConfig& config);
  void level_changed(std::size_t index, bool level);
  void report_edge(Line& line, bool level);

  SimulatedGpioChip& chip_;
  std::array<Line, kMaxGpioLines> lines_{};
  std::size_t held_ = 0;
  FixedQueue<GpioEdgeEvent, kMaxGpioEdgeBuffer> edges_;
  std::size_t edge_capacity_ = 0;
  std::uint32_t sequence_ = 0;
  std::uint32_t losing_ = 0;
};

}  // namespace tactus::hal
