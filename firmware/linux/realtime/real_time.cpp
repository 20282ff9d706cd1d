#include "firmware/linux/realtime/real_time.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace tactus::firmware {

namespace {

// The part of the stack that is loaded. A tick needs far less: its largest frames have 17 kB (the
// programs of implicit surfaces) and 9 kB (CAN frames in flight).
constexpr std::size_t kStack_bytes = std::size_t{256} << 10;
constexpr std::size_t kPage_bytes = 4096;

// Uses the stack's pages once, because the kernel loads a page at its first use.
[[gnu::noinline]] void touch_stack() {
  std::array<volatile std::byte, kStack_bytes> stack;
  for (std::size_t i = 0; i < stack.size(); i += kPage_bytes) {
    stack[i] = std::byte{0};
  }
}

// Keeps the thread on one processor. Returns false with errno.
bool pin(int cpu) {
  if (cpu < 0 || cpu >= CPU_SETSIZE) {
    errno = EINVAL;
    return false;
  }
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<unsigned>(cpu), &set);
  return sched_setaffinity(0, sizeof(set), &set) == 0;
}

}  // namespace

bool become_real_time(const RealTimeConfig& config, RealTimeError& error) {
  bool done = true;
  // Notes the first error and goes on, so that --allow-non-realtime still gets what it can.
  const auto expect = [&](bool succeeded, std::string_view what) {
    if (!succeeded && done) {
      error = {what, errno};
    }
    done = done && succeeded;
  };
  if (config.cpu) {
    expect(pin(*config.cpu), "this machine has no such processor for it");
  }
  expect(mlockall(MCL_CURRENT | MCL_FUTURE) == 0, "memory cannot be locked");
  touch_stack();
  const sched_param wanted{.sched_priority = config.priority};
  expect(sched_setscheduler(0, SCHED_FIFO, &wanted) == 0, "no right to real-time priority");
  return done;
}

void end_real_time() {
  const sched_param ordinary{};
  (void)sched_setscheduler(0, SCHED_OTHER, &ordinary);
}

int CpuLatencyRequest::hold() {
  hal::FileDescriptor device(open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC));
  constexpr std::int32_t kNone_us = 0;
  if (!device.is_open() || write(device.get(), &kNone_us, sizeof(kNone_us)) != sizeof(kNone_us)) {
    return errno;
  }
  device_ = std::move(device);
  return 0;
}

}  // namespace tactus::firmware
