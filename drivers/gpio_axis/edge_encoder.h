// An encoder decoded from the edges of GPIO lines. It has no input or output.
#pragma once

#include <cstdint>

#include "drivers/gpio_axis/count_velocity.h"
#include "drivers/gpio_axis/encoder_reading.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/gpio_axis/index_watch.h"

namespace tactus::drivers {

enum class EncoderChannel : std::uint8_t { a, b, index };

// Decodes edges to counts. After the first doubt the position is invalid until the next restart.
// The doubts are: a missing sequence number, a level that repeats, edges of both channels closer in
// time than the fastest shaft makes them, and levels that differ from those after the last edges.
//
// Too close is less than a quarter of the time between edges at the fastest speed, and less than
// kInterrupts_ns. Then both channels changed at once, or interrupts that waited were served one
// after the other, and their order and the direction are random. Interrupts that merged leave no
// gap in the numbers, but show as edges that are too close or as a repeated level.
class EdgeEncoder {
 public:
  // The largest distance of the kernel's time stamps of interrupts that waited together. Each
  // interrupt has a thread of its own.
  static constexpr hal::TimeNs kInterrupts_ns = 20'000;
  // The time for which levels may disagree with the edges, since a late interrupt is no fault.
  static constexpr hal::TimeNs kDisagreement_ns = 5'000'000;

  EdgeEncoder(const EncoderConfig& config, bool has_index);

  // Starts at count 0 with the levels as they were at that time. Edges from before are ignored,
  // because the levels contain them.
  void restart(bool a, bool b, bool index, hal::TimeNs now_ns);

  // Takes an edge, in the order of the sequence numbers, on any channel. `rising` and the time are
  // the board's.
  void take(EncoderChannel channel, bool rising, hal::TimeNs time_ns);

  // Compares the levels with the edges. They were read while no edge was waiting.
  void compare(bool a, bool b, hal::TimeNs now_ns);

  // Sets a fault that the caller found. The first fault stays.
  void fail(EncoderFault fault) {
    if (decoded_.fault == EncoderFault::none) {
      decoded_.fault = fault;
    }
  }

  [[nodiscard]] EncoderReading reading(hal::TimeNs now_ns) const;
  [[nodiscard]] std::uint64_t illegal_transitions() const { return decoded_.illegal; }
  [[nodiscard]] std::int64_t index_error() const { return index_.error(); }

 private:
  struct Settings {
    bool has_index = false;
    // The state of A and B in which the index is latched.
    unsigned index_state = 0;
    // Edges of both channels that are closer than this are rejected.
    hal::TimeNs least_interval_ns = 0;
  };
  // The result of the edges since the last restart.
  struct Decoded {
    // The levels of A and B, quadrature.h.
    unsigned state = 0;
    std::int64_t count = 0;
    // The number of rejected edges.
    std::uint64_t illegal = 0;
    EncoderFault fault = EncoderFault::none;
  };
  struct LastEdge {
    hal::TimeNs time_ns = 0;
    // `index`: no edge yet.
    EncoderChannel channel = EncoderChannel::index;
  };
  struct IndexPulse {
    bool is_high = false;
    // The count was latched in this pulse.
    bool is_latched = false;
  };

  void take_index(bool rising);
  void latch_if_gated();
  void reject();

  Settings settings_;
  CountVelocity velocity_;
  IndexWatch index_;

  Decoded decoded_;
  hal::TimeNs restarted_ns_ = 0;
  LastEdge last_edge_;
  IndexPulse pulse_;
  // The time since which the levels disagree with the edges; 0: they agree.
  hal::TimeNs disagrees_since_ns_ = 0;
};

}  // namespace tactus::drivers
