// `tactus deploy`: brings packages and images to a board, and puts back what was there before if
// the service does not become healthy. README.md has the steps.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "host_tools/deploy/board.h"

namespace tactus::host {

// The options of a deployment.
struct DeployOptions {
  BoardAddress board;
  // The folder with the packages, or with a folder of packages for each architecture.
  std::filesystem::path packages;
  // The time that the service may take to become active, s.
  unsigned timeout_s = 30;
  // Prints the steps and changes nothing.
  bool dry_run = false;
  // Deploys although a hand may feel forces.
  bool force = false;
  // Deploys although `tactus doctor` finds something to mend.
  bool ignore_doctor = false;
  // Deploys although the board's present packages cannot be put back.
  bool no_rollback = false;
};

// The exit codes of a deployment. board.sh has the first four, too.
enum class DeployOutcome : int {
  deployed = 0,
  // A step failed, and everything is as it was before.
  put_back = 1,
  // Nothing was changed.
  refused = 2,
  // A step failed, and not everything is as it was before.
  broken = 3,
  // The connection was lost; the board goes on by itself.
  unknown = 4,
};

// Deploys. `images` is a folder with device.tactus, scene.tactus, both or none; the packages and
// the script for the board are put beside them. Each line of the progress goes to `say`. Throws
// InputError if nothing was changed, with the remedy.
DeployOutcome deploy(const DeployOptions& options, const std::filesystem::path& images,
                     const OnLine& say);

}  // namespace tactus::host
