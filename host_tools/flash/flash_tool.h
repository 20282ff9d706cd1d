// Writes a program to a board by a tool of the machine: OpenOCD, or the user's own. Host tools, one
// thread.
#pragma once

#include <string>
#include <vector>

namespace tactus::host {

// The tool that writes a program, and its settings.
struct FlashPlan {
  std::string program;
  // OpenOCD's configuration files for the probe and the board.
  std::vector<std::string> configs;
  // The user's own command line, in which {file} stands for the program; empty: OpenOCD.
  std::string with;
};

// Returns the command line for a shell. Throws InputError if the plan names neither a configuration
// nor a command, or both, if the command has no {file}, if the program is missing or, for OpenOCD,
// is no program for a board.
std::string flash_command(const FlashPlan& plan);

// Runs a command of flash_command(), which prints its own progress. Returns true if it ended with
// exit code 0. Throws InputError if its tool is not installed.
bool run_flash_command(const std::string& command);

}  // namespace tactus::host
