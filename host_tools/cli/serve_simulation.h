// `tactus sim --serve`: the simulated device in wall-clock time, behind the same sockets as
// tactusd.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/simulation/run.h"

namespace tactus::host {

struct ServeOptions {
  std::filesystem::path run_dir;  // made if it is not there
  bool allow_inject = false;
  std::string record;  // this file, from the first tick; empty: none
};

// Serves a simulation until SIGINT or SIGTERM, or for as long as `run` says. The hand repeats its
// path to and fro; the operator homes and enables. Throws InputError, text for a user.
void serve_simulation(const std::filesystem::path& scene, const RunOptions& run,
                      const ServeOptions& options);

}  // namespace tactus::host
