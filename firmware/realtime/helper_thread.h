// A thread beside the loop, for what may take its time: no heap, no exceptions, never in the loop's
// way.
#pragma once

#include <pthread.h>

namespace tactus::firmware {

class HelperThread {
 public:
  using Body = void (*)(void* context);

  HelperThread() = default;
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;
  ~HelperThread() { join(); }

  // Runs `body(context)` at ordinary priority whatever the caller's is, with all signals left to
  // the caller's thread. `name` has at most 15 characters. 0, or errno. Once; before the loop
  // begins.
  int start(const char* name, Body body, void* context);

  // Waits until the body has returned; at once if none was started.
  void join();

 private:
  Body body_ = nullptr;
  void* context_ = nullptr;
  pthread_t thread_{};
  bool started_ = false;

  static void* enter(void* self);
};

}  // namespace tactus::firmware
