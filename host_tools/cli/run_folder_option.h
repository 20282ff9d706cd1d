// The options by which a verb finds the sockets of a running controller's device.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "host_tools/remote/remote.h"
#include "rendering/limits.h"

namespace tactus::host {

// The controller's folder and the number of its device, 1 for the first.
struct RunFolderOption {
  std::string run_dir = std::string(kDefaultRunDir);
  std::size_t device = 1;

  // Returns the folder of the device's sockets.
  [[nodiscard]] std::filesystem::path folder() const { return run_folder_of(run_dir, device); }
};

// Adds --run-dir and --device to a verb. `option` must live as long as the verb.
inline void add_run_folder_option(CLI::App& verb, RunFolderOption& option) {
  verb.add_option("--run-dir", option.run_dir,
                  "Folder of the controller's sockets, as tactusd was given it")
      ->envname("TACTUS_RUN_DIR")
      ->capture_default_str();
  verb.add_option("--device", option.device,
                  "Number of the device, in the order in which tactusd was given them")
      ->check(CLI::Range(std::size_t{1}, rendering::kMaxTools))
      ->capture_default_str();
}

}  // namespace tactus::host
