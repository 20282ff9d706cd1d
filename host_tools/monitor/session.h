// The monitor at work: live telemetry to the screen, keys to the command socket.
#pragma once

#include <filesystem>

namespace tactus::host {

// Runs the monitor until q, SIGINT or SIGTERM. It waits for a controller that has gone. Throws
// InputError if none runs at the start, or if this is no terminal.
void run_monitor(const std::filesystem::path& run_dir);

}  // namespace tactus::host
