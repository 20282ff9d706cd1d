// A thread beside the loop for work that is not real time. It uses no heap and no exceptions, and
// the loop never waits for it.
#pragma once

#include <pthread.h>

#include <cstddef>

#include "firmware/linux/realtime/crash_stop.h"
#include "hal/clock.h"

namespace tactus::firmware {

// The owner of one thread. The thread that starts it also joins it.
class HelperThread {
 public:
  // The whole stack is locked in memory, so it is smaller than the default of 8 MB.
  static constexpr std::size_t kStack_bytes = std::size_t{256} << 10;

  // The function that the thread runs.
  using Body = void (*)(void* context);

  HelperThread() = default;
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;
  ~HelperThread() { join(); }

  // Runs `body(context)` in a thread of ordinary priority, whatever the caller's priority is. The
  // thread blocks all signals but its own crashes (crash_stop.h). `name` has at most 15 characters.
  // Call before the loop begins, and again only after join(). Returns 0 or errno.
  int start(const char* name, Body body, void* context, std::size_t stack_bytes = kStack_bytes);

  // Waits until the body has returned. Returns at once if no thread was started.
  void join();

  // Waits at most `limit_ns`. Returns false if the body still hangs in a system call: the thread is
  // then abandoned, and the program must end without running destructors.
  bool join_within(hal::TimeNs limit_ns);

 private:
  Body body_ = nullptr;
  void* context_ = nullptr;
  pthread_t thread_{};
  bool started_ = false;
  CrashStack crash_stack_;

  // The thread's first function: it takes the crash stack and runs the body.
  static void* enter(void* self);
};

}  // namespace tactus::firmware
