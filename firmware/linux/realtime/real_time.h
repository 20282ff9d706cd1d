// Makes the calling thread a real-time thread, and keeps the processors awake for it.
#pragma once

#include <optional>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

// The rights that the thread asks for.
struct RealTimeConfig {
  // The priority of SCHED_FIFO, 1 to 99. Kernels' interrupt threads are at 50: the loop comes
  // first.
  int priority = 80;
  // The processor on which alone the thread runs; none: any.
  std::optional<int> cpu;
};

// The first step that failed.
struct RealTimeError {
  // The text for the user.
  std::string_view what;
  int errno_value = 0;
};

// Pins the thread to its processor; loads and locks all present and future pages of the process in
// memory; does the same for the part of the stack that a tick can use; and sets SCHED_FIFO, in this
// order. Returns false if the process has no right to a step or the machine does not support it.
// `error` then holds the first reason, and the other steps are done all the same. Not real time.
bool become_real_time(const RealTimeConfig& config, RealTimeError& error);

// Makes the thread an ordinary one again, so that work after the loop does not block the machine.
// Memory stays locked.
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
