// Reads index pulses from the character device of a counter (linux/counter.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hal/counter.h"
#include "hal/linux/system.h"

namespace tactus::hal {

// Makes the counter's device report the count number `count` at every index pulse. Returns the
// descriptor for read_counter_index. Not real time.
//   not_supported  the counter has no such event, or the kernel no such device
//   busy           another program watches events
//   not_found, not_permitted, disconnected, io
Result<FileDescriptor> watch_counter_index(const std::string& device, std::uint8_t count);

// Implements Counter::read_index. `descriptor` delivers `struct counter_event`. An event whose
// count the kernel could not read is skipped.
Result<std::size_t> read_counter_index(int descriptor, std::span<CounterIndexEvent> events,
                                       TimeNs deadline_ns);

}  // namespace tactus::hal
