// Runs the program of a board in QEMU, with the board's UART on a Unix socket. Host tools; one
// thread, the process's first.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tactus::host {

// The program and the emulator.
struct EmulatedBoard {
  std::string program;
  // QEMU's name of the board.
  std::string machine = "mps2-an500";
  // The path of the socket that the UART is on.
  std::string line = "board.sock";
};

// Returns QEMU's command line, word for word. An instruction takes 2 ns of the board's time, and
// EmulatorPace holds that to the time of this machine. The board's UART is QEMU's standard input
// and output, and its monitor the descriptor kMonitorDescriptor.
std::vector<std::string> emulator_command(const EmulatedBoard& board);

// Runs the board from the moment when the line is first opened until SIGINT or SIGTERM, or until
// QEMU ends. Calls `ready` when the line can be opened. Returns true if the user ended it, false if
// QEMU failed. Throws InputError if QEMU is not installed, the program is none for a board, or
// there is a file in the place of the line.
bool run_emulated_board(const EmulatedBoard& board, const std::function<void()>& ready);

}  // namespace tactus::host
