// Watches that the encoder's count changes while the motor pushes. It has no input or output.
#pragma once

#include <cstdint>

#include "hal/clock.h"

namespace tactus::drivers {

class SilenceWatch {
 public:
  // Starts at count 0.
  void restart(hal::TimeNs now_ns) {
    count_ = 0;
    since_ns_ = now_ns;
  }

  // Takes the count of a tick. Returns the time for which the motor has pushed and the count has
  // not changed.
  hal::TimeNs take(bool pushes, std::int64_t count, hal::TimeNs now_ns) {
    if (!pushes || count != count_) {
      count_ = count;
      since_ns_ = now_ns;
    }
    return now_ns - since_ns_;
  }

 private:
  std::int64_t count_ = 0;
  hal::TimeNs since_ns_ = 0;
};

}  // namespace tactus::drivers
