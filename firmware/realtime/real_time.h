// Making the calling thread a real-time one.
#pragma once

#include <string_view>

namespace tactus::firmware {

struct RealTimeError {
  std::string_view what;
  std::string_view remedy;
  int errno_value = 0;
};

// SCHED_FIFO at that priority, and every page of the process, present and future, locked in memory.
// Not real time itself. False, with the reason, where the process has no right to.
bool become_real_time(int priority, RealTimeError& error);

}  // namespace tactus::firmware
