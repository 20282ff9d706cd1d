// Index pulses from the character device of a counter (linux/counter.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hal/counter.h"
#include "hal/linux/system.h"

namespace tactus::hal {

// Asks the counter's device to report `count` of that number at every index pulse, and returns the
// descriptor from which read_counter_index reads. Not real time.
//   not_supported  the counter has no such event, or the kernel no such device
//   busy           another program watches events
//   not_found, not_permitted, disconnected, io
Result<FileDescriptor> watch_counter_index(const std::string& device, std::uint8_t count);

// As Counter::read_index. `descriptor` yields `struct counter_event`. An event whose count the
// kernel could not read is left out.
Result<std::size_t> read_counter_index(int descriptor, std::span<CounterIndexEvent> events,
                                       TimeNs deadline_ns);

}  // namespace tactus::hal
