// A quadrature counter in memory. One thread; see simulated/clock.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/counter.h"
#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"

namespace tactus::hal {

// A counter whose encoder the test moves.
//
// Simulated: a count that wraps, index pulses kept until read (the newest is lost if 64 wait, as in
// the kernel), noise, removal. Not simulated: the signals, a missed count.
class SimulatedCounter final : public Counter {
 public:
  // The number of index pulses that are kept, as in the kernel.
  static constexpr std::size_t kIndexEvents = 64;

  // `hardware_ceiling` is the default ceiling and the largest possible one.
  explicit SimulatedCounter(SimulatedClock& clock, std::uint64_t hardware_ceiling = 0xFFFF)
      : clock_(clock), hardware_ceiling_(hardware_ceiling), ceiling_now_(hardware_ceiling) {}

  // Moves the encoder by `steps`, at most half the ceiling in either direction.
  void move(std::int64_t steps);
  // Gives an index pulse at the present count, if start() asked for them.
  void pulse_index();
  // Sets CounterReading::noisy of the next readings.
  void set_noisy(bool noisy) { noisy_ = noisy; }

  // After remove() every call returns `disconnected`, until plug_in().
  void remove() { present_ = false; }
  void plug_in() { present_ = true; }

 private:
  Result<std::uint64_t> DoStart(const CounterConfig& config) override;
  Result<CounterReading> DoRead() override;
  Result<std::size_t> DoReadIndex(std::span<CounterIndexEvent> events, TimeNs deadline_ns) override;

  SimulatedClock& clock_;
  std::uint64_t hardware_ceiling_;
  // The ceiling in effect since start().
  std::uint64_t ceiling_now_;
  std::uint64_t count_ = 0;
  CountDirection direction_ = CountDirection::forward;
  FixedQueue<CounterIndexEvent, kIndexEvents> index_events_;
  bool watches_index_ = false;
  bool noisy_ = false;
  bool present_ = true;
};

}  // namespace tactus::hal
