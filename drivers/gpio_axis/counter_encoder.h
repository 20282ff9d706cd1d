// An encoder on a hardware counter. It has no input or output.
#pragma once

#include <cstdint>

#include "drivers/gpio_axis/count_velocity.h"
#include "drivers/gpio_axis/encoder_reading.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/gpio_axis/index_watch.h"
#include "hal/counter.h"

namespace tactus::drivers {

// Follows the count over its wraps. A doubt ends the position until the next restart: more travel
// than the shaft can make in the time since the last reading, a time in which it could have turned
// half the counter's range, noise that the counter reports, or an index in another place.
class CounterEncoder {
 public:
  explicit CounterEncoder(const EncoderConfig& config);

  // Starts at count 0 with that reading. `ceiling` is the largest value of the counter.
  void restart(const hal::CounterReading& reading, std::uint64_t ceiling);

  // Takes an index pulse. Call it for the pulses since the last reading, before the next `take`.
  void take_index(const hal::CounterIndexEvent& event);
  void take(const hal::CounterReading& reading);

  void fail(EncoderFault fault) {
    if (fault_ == EncoderFault::none) {
      fault_ = fault;
    }
  }

  [[nodiscard]] EncoderReading reading() const;
  [[nodiscard]] std::int64_t index_error() const { return index_.error(); }

 private:
  bool has_index_;
  double max_counts_per_s_;
  CountVelocity velocity_;
  IndexWatch index_;

  hal::CounterReading last_;
  std::uint64_t ceiling_ = 1;
  std::int64_t count_ = 0;
  EncoderFault fault_ = EncoderFault::none;
};

}  // namespace tactus::drivers
