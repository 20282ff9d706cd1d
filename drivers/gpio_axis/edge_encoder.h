// An encoder decoded from the edges of GPIO lines. Protocol only: no input or output.
#pragma once

#include <cstdint>

#include "drivers/gpio_axis/count_velocity.h"
#include "drivers/gpio_axis/encoder_reading.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/gpio_axis/index_watch.h"

namespace tactus::drivers {

enum class EncoderChannel : std::uint8_t { a, b, index };

// A position is worth nothing after the first doubt, until the next restart: a missing sequence
// number, a level that repeats, edges of both channels closer in time than the fastest shaft makes
// them, levels that stay otherwise than the edges left them.
//
// Too close is less than a quarter of the time between edges at the fastest speed, and less than
// kInterrupts_ns: both channels changed at once, or interrupts that waited were served one after
// the other. Their order is chance then, and so is the direction. Interrupts that ran together
// leave no gap in the numbers; what they hide shows as one of these or as a repeated level.
class EdgeEncoder {
 public:
  // How far apart the kernel's times of interrupts that waited together may be: one thread each.
  static constexpr hal::TimeNs kInterrupts_ns = 20'000;
  // How long levels may disagree with the edges: an interrupt that is late is no fault.
  static constexpr hal::TimeNs kDisagreement_ns = 5'000'000;

  EdgeEncoder(const EncoderConfig& config, bool has_index);

  // Begins at count 0 with the levels as they were at that time. Edges from before are in them
  // already and are ignored.
  void restart(bool a, bool b, bool index, hal::TimeNs now_ns);

  // An edge, in the order of the sequence numbers. The board's word counts, whatever the channel.
  void take(EncoderChannel channel, bool rising, hal::TimeNs time_ns);

  // The levels, read while no edge was waiting.
  void compare(bool a, bool b, hal::TimeNs now_ns);

  // What somebody else found wrong. The first fault stays.
  void fail(EncoderFault fault) {
    if (fault_ == EncoderFault::none) {
      fault_ = fault;
    }
  }

  [[nodiscard]] EncoderReading reading(hal::TimeNs now_ns) const;
  [[nodiscard]] std::uint64_t illegal_transitions() const { return illegal_; }
  [[nodiscard]] std::int64_t index_error() const { return index_.error(); }

 private:
  void take_index(bool rising);
  void latch_if_gated();
  void reject();

  bool has_index_;
  unsigned gate_;
  hal::TimeNs least_interval_ns_;
  CountVelocity velocity_;
  IndexWatch index_;

  unsigned state_ = 0;
  std::int64_t count_ = 0;
  std::uint64_t illegal_ = 0;
  hal::TimeNs restarted_ns_ = 0;
  hal::TimeNs last_edge_ns_ = 0;
  EncoderChannel last_channel_ = EncoderChannel::index;  // index: no edge yet
  hal::TimeNs disagrees_since_ns_ = 0;                   // 0: agrees
  bool index_high_ = false;
  bool latched_ = false;  // in this pulse
  EncoderFault fault_ = EncoderFault::none;
};

}  // namespace tactus::drivers
