#include "firmware/realtime/helper_thread.h"

#include <sched.h>

#include <csignal>
#include <cstddef>

namespace tactus::firmware {

namespace {

// All of it is locked in memory, as everything is: not the 8 MB that a thread has by default.
constexpr std::size_t kStackOfThread_bytes = std::size_t{256} << 10;

}  // namespace

void* HelperThread::enter(void* self) {
  const auto* thread = static_cast<const HelperThread*>(self);
  thread->body_(thread->context_);
  return nullptr;
}

int HelperThread::start(const char* name, Body body, void* context) {
  body_ = body;
  context_ = context;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackOfThread_bytes);
  const sched_param ordinary{};
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &ordinary);

  // A thread begins with the signals of the one that makes it.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const int failed = pthread_create(&thread_, &attributes, enter, this);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
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

}  // namespace tactus::firmware
