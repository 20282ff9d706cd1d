// Commissioning with the real device: its boards on this machine's interfaces, and a person at the
// keyboard. `tactus commission` uses it, as root or in the group tactus, while tactusd is not
// running.
#pragma once

#include <memory>
#include <span>

#include "firmware/device_file/device_config.h"
#include "host_tools/commission/bench.h"

namespace tactus::host {

// How the bench runs.
struct BoardBenchOptions {
  // True if nobody is at the keyboard: tasks are then timed instead of confirmed.
  bool unattended = false;
  // The time for moving the handle everywhere, if unattended.
  double travel_s = 20.0;
  // The SCHED_FIFO priority of the loop; without the right to it ticks may be late.
  int priority = 80;
};

// Opens the boards and starts the drives. A signal that would end the program makes wait() throw
// InputError instead, so that the motors' power goes off first; the destructor takes it in any
// case. Throws InputError if the device is in use or a board does not open.
std::unique_ptr<Bench> open_board_bench(const firmware::DeviceConfig& config,
                                        std::span<const std::byte> falcon_firmware,
                                        const BoardBenchOptions& options);

}  // namespace tactus::host
