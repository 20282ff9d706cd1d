// A thread beside the loop for work that is not real time. It uses no heap and no exceptions, and
// the loop never waits for it.
#pragma once

#include <pthread.h>

#include <cstddef>

#include "firmware/realtime/crash_stop.h"
#include "hal/clock.h"

namespace tactus::firmware {

class HelperThread {
 public:
  // The whole stack is locked in memory, so it is smaller than the default of 8 MB.
  static constexpr std::size_t kStack_bytes = std::size_t{256} << 10;

  using Body = void (*)(void* context);

  HelperThread() = default;
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;
  ~HelperThread() { join(); }

  // Runs `body(context)` at ordinary priority whatever the caller's is, with all signals left to
  // the caller's thread, but for those of its own crashes (crash_stop.h). `name` has at most 15
  // characters. 0, or errno. Before the loop begins; again only after join().
  int start(const char* name, Body body, void* context, std::size_t stack_bytes = kStack_bytes);

  // Waits until the body has returned; at once if none was started.
  void join();

  // Waits so long at most. False: the body hangs in a call of the system; the thread is left alone
  // for good, and the program has to end without running destructors.
  bool join_within(hal::TimeNs limit_ns);

 private:
  Body body_ = nullptr;
  void* context_ = nullptr;
  pthread_t thread_{};
  bool started_ = false;
  CrashStack crash_stack_;

  static void* enter(void* self);
};

}  // namespace tactus::firmware
