// Makes the calling thread a real-time thread, and keeps the processors awake for it.
#pragma once

#include <optional>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

struct RealTimeConfig {
  int priority = 80;       // SCHED_FIFO, 1 to 99; kernels' interrupt threads are at 50
  std::optional<int> cpu;  // the thread runs on this processor only
};

struct RealTimeError {
  std::string_view what;
  int errno_value = 0;
};

// In this order: pins the thread; locks every page of the process, present and future, in memory
// and has it there; does the same for as much of the thread's stack as a tick can ever use;
// SCHED_FIFO. Not real time itself. False, with the first reason, where the process has no right to
// something or the machine does not have it; the rest is done all the same.
bool become_real_time(const RealTimeConfig& config, RealTimeError& error);

// Back to an ordinary thread, for what is done after the loop: it would keep the machine from
// everything else. Memory stays locked.
void end_real_time();

// Keeps all processors out of deep sleep states while it lives, by the Linux request
// /dev/cpu_dma_latency with 0 us. Not real time.
class CpuLatencyRequest {
 public:
  // Starts the request. Returns 0 or errno; EACCES if only root may open the device.
  int hold();

 private:
  hal::FileDescriptor device_;
};

}  // namespace tactus::firmware
