// `tactus sim --serve`: the simulated device in wall-clock time, behind the same sockets as
// tactusd.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/simulation/run.h"

namespace tactus::host {

// How the simulation is served.
struct ServeOptions {
  // The folder of the sockets; it is made if it is not there.
  std::filesystem::path run_dir;
  // True if `tactus inject` may raise faults.
  bool allow_inject = false;
  // A file that records the run from its first tick; empty: none.
  std::string record;
};

// Serves until SIGINT or SIGTERM, or for `run.seconds`. The hand repeats its path to and fro;
// homing and enabling are left to the user's commands. Throws InputError.
void serve_simulation(const std::filesystem::path& scene, const RunOptions& run,
                      const ServeOptions& options);

}  // namespace tactus::host
