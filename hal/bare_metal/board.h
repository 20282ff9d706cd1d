// The functions of a board without an operating system. The portable part (firmware/bare_metal)
// calls them, and each board has a file that defines them: firmware/mps2_an500/board.cpp is an
// example, and its README is the guide "Port to a chip".
//
// None of them waits, but for wait_for_tick. All are for the program's one thread; a comment says
// which may be called from a handler, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bare_metal/stop_code.h"

namespace tactus::hal {

// Takes the motors' power, or gives it. motors_off() may be called from any handler; it works
// whatever the program has done to its memory.
void motors_off();
void motors_on();

// Starts a timer that ends a period `rate_hz` times a second, and the receiver of the UART.
void start_ticks(std::uint32_t rate_hz);

// Sleeps until the end of a period, and returns how many have ended since the last call: 1 if the
// caller is in time. It does not sleep if one has ended already. It returns 0 where something else
// has ended the sleep, such as room for a character in the UART, which must do so.
std::uint32_t wait_for_tick();

// Returns a monotonic time, ns; it stands still before start_ticks. It may be called from the tick.
std::uint64_t now_ns();

// Starts the watchdog. If it is not fed within `timeout_us`, it interrupts the program by an
// interrupt that cannot be masked, whose handler stops with StopCode::watchdog; and it restarts the
// board after as long again. Calling it again feeds it and changes the time. It may be called from
// any handler.
void start_watchdog(std::uint32_t timeout_us);
// Starts the watchdog's time anew. Only the end of a healthy tick calls it.
void feed_watchdog();

// Gives a character to the UART. Returns false if the UART has no room for it now. It may be called
// from any handler.
bool put_char(char character);

// Takes the next character that the UART has received since start_ticks. Returns false if there is
// none. Characters come at any time, also in a tick: an interrupt puts them into memory, which has
// room for those of two periods or more.
bool get_char(char& character);
// Returns the number of characters that came too fast for the UART or for that memory.
std::uint32_t lost_chars();

// Returns memory that keeps its content over a restart, but not without power. It may be called
// from any handler.
LatchedStop& latched_stop();

// Returns the program's stack as words. The start has painted all words that were not in use with
// kStackPaint; a stack grows from the last word down.
std::span<const std::uint32_t> stack_memory();
inline constexpr std::uint32_t kStackPaint = 0xC0FFEE42;

// The bytes of the images in the program's own memory, in which they stay.
struct BoardImages {
  std::span<const std::byte> device;
  std::span<const std::byte> scene;
};
BoardImages images();

// Waits without power for the motors and with the least work, for ever. It may be called from any
// handler.
[[noreturn]] void halt();

}  // namespace tactus::hal
