// The monitor at work: it shows the live telemetry and sends keys to the command socket.
#pragma once

#include <filesystem>

namespace tactus::host {

// Runs the monitor until q, SIGINT, SIGTERM or SIGHUP. It waits for a controller that has gone.
// Throws InputError if no controller runs at the start, or if this is not a terminal.
void run_monitor(const std::filesystem::path& run_dir);

}  // namespace tactus::host
