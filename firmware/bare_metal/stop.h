// The stop of a program on a bare board: from a handler, or where it cannot go on.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/bare_metal/line.h"
#include "hal/bare_metal/stop_code.h"

namespace tactus::firmware {

// Takes the motors' power, latches the code, tells it with `words`, and never returns: the
// watchdog, if it runs, restarts the board, which then tells the code again. `address` is that of
// the interrupted instruction, 0 if it is not known. It may be called from any handler.
[[noreturn]] void stop(hal::StopCode code, std::uint32_t address = 0, std::string_view words = {});

// Returns the line of a latched stop: `verb`, its code and name, and the address if it is known.
Line stop_line(std::string_view verb, const hal::LatchedStop& stop);

// Tells a line at once, without the loop. A UART that takes nothing is given up. It may be called
// from any handler.
void tell_now(std::string_view line);

}  // namespace tactus::firmware
