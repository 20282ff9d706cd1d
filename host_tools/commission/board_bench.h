// The real device on the bench: its boards on this machine's interfaces, and a person at the
// keyboard.
#pragma once

#include <memory>
#include <span>

#include "firmware/device_file/device_config.h"
#include "host_tools/commission/bench.h"

namespace tactus::host {

struct BoardBenchOptions {
  bool unattended = false;  // nobody is asked: what the hand does is timed
  double travel_s = 20.0;   // then, for the hand to move the handle everywhere
  int priority = 80;        // SCHED_FIFO; without the right to it the loop may be late
};

// Opens the boards and starts the drives. A signal that would end the program ends `wait` with an
// InputError instead, so that the motors' power goes off first; the destructor takes it in any
// case. Throws InputError, text for the user, if a board does not open.
std::unique_ptr<Bench> open_board_bench(const firmware::DeviceConfig& config,
                                        std::span<const std::byte> falcon_firmware,
                                        const BoardBenchOptions& options);

}  // namespace tactus::host
