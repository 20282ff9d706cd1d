// `tactus sim --serve`: the simulated devices in wall-clock time, behind the same sockets as
// tactusd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host_tools/simulation/run.h"

namespace tactus::host {

// How the simulation is served.
struct ServeOptions {
  // The folder of the first device's sockets, which is made if it is not there; that of the second
  // is 2 in it.
  std::filesystem::path run_dir;
  // True if `tactus inject` may raise faults.
  bool allow_inject = false;
  // The port of this machine that gets JSON of the first device, and the next one that of the
  // second; 0: none.
  std::uint16_t udp_port = 0;
  // A file that records the run of the first device from its first tick, and run.2.mcap beside
  // run.mcap that of the second; empty: none.
  std::string record;
};

// Serves until SIGINT or SIGTERM, or for `run.seconds`. Each hand repeats its path to and fro;
// homing and enabling are left to the user's commands. Throws InputError.
void serve_simulation(const std::filesystem::path& scene, const RunOptions& run,
                      const ServeOptions& options);

}  // namespace tactus::host
