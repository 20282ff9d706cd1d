#include "host_tools/cli/deploy_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/cli/bake_report.h"
#include "host_tools/deploy/deploy.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kDeployExamples =
    "Bakes here, copies the packages for the board's processor and the images, installs them,\n"
    "restarts tactusd and waits until it is active and `tactus doctor` has nothing to mend. If a\n"
    "step fails, the board puts back what it had, also when the connection is lost meanwhile. The\n"
    "user of the board is root, or may sudo without a password. host_tools/deploy/README.md has\n"
    "the steps.\n"
    "Exit codes: 0 deployed; 1 a step failed, everything is as before; 2 nothing was changed; 3 a\n"
    "step failed, and not everything is as before; 4 the connection was lost, and the board goes\n"
    "on by itself.\n"
    "\n"
    "Examples:\n"
    "  tactus deploy pi@board --dry-run                     says what it would do\n"
    "  tactus deploy pi@board --device arm.toml --scene scene.toml\n"
    "  tactus deploy pi@board                               the packages alone\n"
    "  tactus deploy pi@board --identity key --ssh-option Port=2222\n"
    "  toolchains/debian-packages.sh arm64 && tactus deploy pi@board --packages build/packages";

// The verb's options as the user gave them.
struct DeployVerbOptions {
  DeployOptions deploy;
  std::string packages = "build/packages";
  std::string device;
  std::string scene;
};

// Copies an image that is baked already. Throws InputError.
void copy_image(const std::string& file, const std::filesystem::path& image) {
  std::error_code failure;
  std::filesystem::copy_file(file, image, failure);
  if (failure) {
    throw InputError(fmt::format("{}: cannot be read: {}", file, failure.message()));
  }
}

bool is_image(const std::string& file) {
  return std::filesystem::path(file).extension() == ".tactus";
}

void bake_deployed_device(const std::string& file, const std::filesystem::path& image) {
  if (is_image(file)) {
    copy_image(file, image);
    return;
  }
  const LoadedDevice device = bake_device(file);
  for (const std::string& warning : device.warnings()) {
    fmt::print(stderr, "tactus deploy: warning: {}\n", warning);
  }
  write_file_atomically(image, device.image());
}

void bake_deployed_scene(const std::string& file, const std::filesystem::path& image) {
  if (is_image(file)) {
    copy_image(file, image);
    return;
  }
  print_bake_warnings("deploy", bake_with_progress(file, image));
}

void run_deploy(DeployVerbOptions& options) {
  const PrivateFolder images;
  if (!options.device.empty()) {
    bake_deployed_device(options.device, images.path() / "device.tactus");
  }
  if (!options.scene.empty()) {
    bake_deployed_scene(options.scene, images.path() / "scene.tactus");
  }
  options.deploy.packages = options.packages;
  const DeployOutcome outcome = deploy(options.deploy, images.path(), [](std::string_view line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  });
  if (outcome != DeployOutcome::deployed) {
    throw CLI::RuntimeError(static_cast<int>(outcome));
  }
}

}  // namespace

void add_deploy_verb(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("deploy", "Install packages and images on a board, or leave it as it was");
  const auto options = std::make_shared<DeployVerbOptions>();
  DeployOptions& deploy = options->deploy;
  verb->add_option("board", deploy.board.target, "The board, as for ssh: user@board")->required();
  verb->add_option("--device", options->device,
                   "Device (.toml or .tactus); default: as it is there");
  verb->add_option("--scene", options->scene, "Scene (.toml or .tactus); default: as it is there");
  verb->add_option("--packages", options->packages,
                   "Folder of the .deb files, or with a folder for each architecture")
      ->capture_default_str();
  verb->add_option("--identity", deploy.board.identity, "Private key for ssh");
  verb->add_option("--ssh-option", deploy.board.options, "Option of ssh's -o; may be repeated")
      ->allow_extra_args(false);
  verb->add_option("--timeout", deploy.timeout_s, "Seconds that tactusd may take to become active")
      ->check(CLI::Range(1, 600))
      ->capture_default_str();
  verb->add_flag("--dry-run", deploy.dry_run, "Say what would be done, and change nothing");
  verb->add_flag("--force", deploy.force, "Deploy although a hand may feel forces, which then end");
  verb->add_flag("--ignore-doctor", deploy.ignore_doctor,
                 "Deploy although tactus doctor finds something to mend");
  verb->add_flag("--no-rollback", deploy.no_rollback,
                 "Deploy although the board's present packages cannot be put back");
  verb->footer(kDeployExamples);
  verb->callback([options] { run_deploy(*options); });
}

}  // namespace tactus::host
