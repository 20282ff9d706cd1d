// Waits for a while after each fault, so that a flight file holds the ticks after it.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/control/mode.h"

namespace tactus::firmware {

// The watch over the modes of one loop. The loop's thread notes them, another thread may ask
// whether a fault waits.
class FaultWatch {
 public:
  // Notes the mode after a tick. Returns true in the tick that is `delay_ticks` after the one in
  // which the mode became `fault`. Real time.
  bool note(Mode mode, std::uint64_t delay_ticks) {
    if (mode == Mode::fault && mode_ != Mode::fault) {
      ticks_to_wait_ = delay_ticks + 1;
      is_waiting_.store(true, std::memory_order_release);
    }
    mode_ = mode;
    if (ticks_to_wait_ == 0) {
      return false;
    }
    --ticks_to_wait_;
    if (ticks_to_wait_ > 0) {
      return false;
    }
    is_waiting_.store(false, std::memory_order_release);
    return true;
  }

  // Returns true while note() has a fault that it has not returned. Any thread.
  [[nodiscard]] bool is_waiting() const { return is_waiting_.load(std::memory_order_acquire); }

 private:
  // The mode of the last tick.
  Mode mode_ = Mode::init;
  // The number of ticks until the fault is returned.
  std::uint64_t ticks_to_wait_ = 0;
  std::atomic<bool> is_waiting_{false};
};

}  // namespace tactus::firmware
