// The monitor at work: it shows the live telemetry and sends keys to the command socket.
#pragma once

#include <filesystem>
#include <functional>

namespace tactus::host {

// Runs the monitor until q, SIGINT, SIGTERM or SIGHUP. It waits for a controller that has gone,
// unless `is_over` says that it will not come back.
// Throws InputError if no controller runs at the start, or if this is not a terminal.
void run_monitor(const std::filesystem::path& run_dir, const std::function<bool()>& is_over);

}  // namespace tactus::host
