// The options by which a verb finds the sockets of a running controller's device.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "host_tools/remote/remote.h"
#include "rendering/limits.h"

namespace tactus::host {

// The controller's folder, and the name of its device or its number, 1 for the first.
struct RunFolderOption {
  std::string run_dir = std::string(kDefaultRunDir);
  std::string device = "1";
  // The serial line to a board in place of a folder; empty: a folder.
  std::string serial;

  // Returns the folder of the device's sockets. Throws UnreachableError if no device has the name.
  [[nodiscard]] std::filesystem::path folder() const { return run_folder_of(run_dir, device); }
};

// Adds --run-dir, --device and --serial to a verb. `option` must live as long as the verb.
inline void add_run_folder_option(CLI::App& verb, RunFolderOption& option) {
  verb.add_option("--run-dir", option.run_dir,
                  "Folder of the controller's sockets, as tactusd was given it")
      ->envname("TACTUS_RUN_DIR")
      ->capture_default_str();
  CLI::Option* const device_option =
      verb.add_option(
              "--device", option.device,
              "Name of the device, that of its image (left.tactus: left), or its number in the "
              "order in which tactusd was given them")
          ->check([](const std::string& device) {
            const bool is_number = device.find_first_not_of("0123456789") == std::string::npos;
            return is_number ? CLI::Range(std::size_t{1}, rendering::kMaxTools)(device)
                             : std::string{};
          });
  device_option->capture_default_str();
  verb.add_option("--serial", option.serial,
                  "In place of a folder, the serial line of a bare board: PATH, PATH:BAUD, or "
                  "unix:PATH of an emulator")
      ->excludes(device_option);
}

}  // namespace tactus::host
