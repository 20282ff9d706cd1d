#include "firmware/linux/tactusd/real_time_thread.h"

#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "firmware/linux/tactusd/messages.h"

namespace tactus::firmware {

bool take_time(const Options& options, CpuLatencyRequest& cpu_latency) {
  RealTimeError error;
  if (!become_real_time({.priority = options.priority, .cpu = options.cpu}, error)) {
    std::fprintf(stderr, "tactusd: %.*s (%s)\n", length(error.what), error.what.data(),
                 std::strerror(error.errno_value));
    if (!options.allow_non_realtime) {
      std::fprintf(stderr,
                   "Give this shell the right to it with\n"
                   "  sudo prlimit --pid %d --rtprio=%d --memlock=unlimited\n"
                   "and start again; --allow-non-realtime goes without, and may miss ticks.\n",
                   getppid(), options.priority);
      return false;
    }
  }
  if (const int refused = cpu_latency.hold(); refused != 0) {
    std::fprintf(stderr, "tactusd: /dev/cpu_dma_latency: %s; processors may sleep deeply\n",
                 std::strerror(refused));
  }
  return true;
}

}  // namespace tactus::firmware
