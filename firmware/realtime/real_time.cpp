#include "firmware/realtime/real_time.h"

#include <sched.h>
#include <sys/mman.h>

#include <cerrno>

namespace tactus::firmware {

bool become_real_time(int priority, RealTimeError& error) {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    error = {"memory cannot be locked",
             "raise the limit (ulimit -l unlimited) or run as root, or give --allow-non-realtime",
             errno};
    return false;
  }
  const sched_param wanted{.sched_priority = priority};
  if (sched_setscheduler(0, SCHED_FIFO, &wanted) != 0) {
    error = {"no real-time priority",
             "allow it (ulimit -r 90) or run as root, or give --allow-non-realtime", errno};
    return false;
  }
  return true;
}

}  // namespace tactus::firmware
