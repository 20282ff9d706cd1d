// Waiting for file descriptors until a deadline of the monotonic clock.
#pragma once

#include <poll.h>

#include <span>

#include "hal/clock.h"

namespace tactus::hal {

// ppoll to an absolute time, to the nanosecond and taken up again after a signal. How many are
// ready, 0 at the deadline, -1 with errno otherwise. Real time.
int wait_for_descriptors(std::span<pollfd> descriptors, TimeNs deadline_ns);

// CLOCK_MONOTONIC, as hal/clock.h counts it.
TimeNs monotonic_now_ns();

}  // namespace tactus::hal
