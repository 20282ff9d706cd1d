// Checks that the index pulse stays in its place.
#pragma once

#include <algorithm>
#include <cstdint>

#include "drivers/gpio_axis/quadrature.h"

namespace tactus::drivers {

// Every pulse must come a whole number of turns after the first one, and a pulse must come within a
// turn and a quarter. This detects causes that lose counts without any other trace, such as dirt or
// a grounded channel.
class IndexWatch {
 public:
  IndexWatch(std::int64_t counts_per_rev, std::int64_t tolerance)
      : counts_per_rev_(counts_per_rev), tolerance_(tolerance) {}

  void restart(std::int64_t count) {
    seen_ = false;
    lowest_ = highest_ = count;
  }

  // Takes a pulse at that count. Returns index_moved or none.
  EncoderFault pulse(std::int64_t count) {
    lowest_ = highest_ = count;
    if (!seen_) {
      seen_ = true;
      first_ = count;
      last_ = count;
      return EncoderFault::none;
    }
    last_ = count;
    error_ = (count - first_) % counts_per_rev_;
    if (error_ > counts_per_rev_ / 2) {
      error_ -= counts_per_rev_;
    } else if (error_ < -counts_per_rev_ / 2) {
      error_ += counts_per_rev_;
    }
    return error_ > tolerance_ || error_ < -tolerance_ ? EncoderFault::index_moved
                                                       : EncoderFault::none;
  }

  // Takes a count between pulses. Returns index_missing or none.
  EncoderFault pass(std::int64_t count) {
    lowest_ = std::min(lowest_, count);
    highest_ = std::max(highest_, count);
    return highest_ - lowest_ > counts_per_rev_ + counts_per_rev_ / 4 ? EncoderFault::index_missing
                                                                      : EncoderFault::none;
  }

  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] std::int64_t last() const { return last_; }    // the newest pulse's count
  [[nodiscard]] std::int64_t error() const { return error_; }  // its error, in counts

 private:
  std::int64_t counts_per_rev_;
  std::int64_t tolerance_;
  std::int64_t first_ = 0;
  std::int64_t last_ = 0;
  std::int64_t error_ = 0;
  std::int64_t lowest_ = 0;
  std::int64_t highest_ = 0;
  bool seen_ = false;
};

}  // namespace tactus::drivers
