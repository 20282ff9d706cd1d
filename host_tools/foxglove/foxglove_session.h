// Serves a running controller to Foxglove and PlotJuggler until somebody ends it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "host_tools/foxglove/server.h"

namespace tactus::host {

// The range of rates: messages of a topic a second. The live socket brings ticks as often as that.
inline constexpr double kLeastFoxgloveRate_Hz = 0.1;
inline constexpr double kMostFoxgloveRate_Hz = 200.0;

struct FoxgloveOptions {
  FoxgloveServerOptions server;
  // The messages of each topic a second.
  double rate_Hz = 60.0;
  // The folder of the controller's first device, which knows the scene.
  std::filesystem::path first_folder;
  // The folder of the device that is shown; empty: all devices of the controller are.
  std::filesystem::path only_folder;
};

// Serves until SIGINT, SIGTERM or SIGHUP, or until `is_over` says that the controller will not come
// back; it waits for one that has gone. Throws InputError if no controller answers at the start,
// or if the port cannot be used.
void serve_foxglove(const FoxgloveOptions& options, const std::function<bool()>& is_over);

}  // namespace tactus::host
