// Helpers for the Linux implementations: an owned file descriptor, conversion of times, blocked
// signals, and waiting for a descriptor. All but the opening of descriptors are real time.
#pragma once

#include <poll.h>

#include <csignal>
#include <ctime>
#include <span>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

// Convert between TimeNs and the system's seconds and nanoseconds.
timespec to_timespec(TimeNs time_ns);
TimeNs to_ns(const timespec& time);
// Returns the time of CLOCK_MONOTONIC.
TimeNs monotonic_now_ns();

// Owns a descriptor and closes it when it is destroyed or assigned another. -1 means none.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  ~FileDescriptor() { reset(); }

  // Returns the descriptor; -1 if there is none.
  [[nodiscard]] int get() const { return descriptor_; }
  // Returns true if there is a descriptor.
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  // Closes the descriptor, if there is one.
  void reset();

 private:
  int descriptor_ = -1;
};

// Changes the calling thread's blocked signals, as pthread_sigmask does, until the end of the
// scope. Threads created meanwhile inherit them.
class SignalMask {
 public:
  SignalMask(int how, const sigset_t& signals) { pthread_sigmask(how, &signals, &before_); }
  SignalMask(const SignalMask&) = delete;
  SignalMask& operator=(const SignalMask&) = delete;
  ~SignalMask() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

// Calls ppoll until an absolute time, again after a signal. Returns how many descriptors are ready,
// 0 at the deadline, or -1 with errno. With kNoWait it looks once. Real time.
int wait_for_descriptors(std::span<pollfd> descriptors, TimeNs deadline_ns);

// Waits until there is something to read or an error to fetch. Returns false at the deadline. Real
// time.
bool wait_readable(int descriptor, TimeNs deadline_ns);

}  // namespace tactus::hal
