#include "firmware/linux/realtime/helper_thread.h"

#include <sched.h>

#include <csignal>

#include "hal/linux/system.h"

namespace tactus::firmware {

void* HelperThread::enter(void* self) {
  auto* thread = static_cast<HelperThread*>(self);
  const UseCrashStack crash_stack(thread->crash_stack_);
  thread->body_(thread->context_);
  return nullptr;
}

int HelperThread::start(const char* name, Body body, void* context, std::size_t stack_bytes) {
  body_ = body;
  context_ = context;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack_bytes);
  const sched_param ordinary{};
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &ordinary);

  // A new thread inherits the signal mask of its creator.
  const hal::SignalMask only_crashes(SIG_SETMASK, all_signals_but_crashes());
  const int failed = pthread_create(&thread_, &attributes, enter, this);
  pthread_attr_destroy(&attributes);
  started_ = failed == 0;
  if (started_) {
    pthread_setname_np(thread_, name);
  }
  return failed;
}

void HelperThread::join() {
  if (started_) {
    pthread_join(thread_, nullptr);
    started_ = false;
  }
}

bool HelperThread::join_within(hal::TimeNs limit_ns) {
  if (!started_) {
    return true;
  }
  const hal::TimeNs deadline_ns = hal::monotonic_now_ns() + limit_ns;
  bool has_ended = pthread_tryjoin_np(thread_, nullptr) == 0;
  while (!has_ended && hal::monotonic_now_ns() < deadline_ns) {
    constexpr timespec kPause{.tv_sec = 0, .tv_nsec = 1'000'000};
    ::nanosleep(&kPause, nullptr);
    has_ended = pthread_tryjoin_np(thread_, nullptr) == 0;
  }
  if (!has_ended) {
    pthread_detach(thread_);
  }
  started_ = false;
  return has_ended;
}

}  // namespace tactus::firmware
