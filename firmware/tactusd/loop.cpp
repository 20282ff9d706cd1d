#include "firmware/tactusd/loop.h"

#include <cmath>

namespace tactus::firmware {

bool LoopCourse::goes_on(Mode mode, bool stopping) {
  --left_;
  in_fault_ = mode == Mode::fault ? in_fault_ + 1 : 0;
  const bool stopped = stopping && mode != Mode::active;
  return left_ > 0 && in_fault_ <= ticks_after_fault_ && !stopped;
}

hal::Phase loop_phase(double rate_hz) {
  return {.period_ns = static_cast<hal::TimeNs>(std::llround(1e9 / rate_hz)), .offset_ns = 0};
}

}  // namespace tactus::firmware
