#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "host_tools/init/device_text.h"

namespace tactus::host {
namespace {

// Returns the options of `tactus emulate` that follow from the plan.
std::string emulated_options(const DevicePlan& plan) {
  if (plan.is_on("vesc_can")) {
    return fmt::format(" --status-ms {:.6g} --torque-constant {}", 1e3 / plan.rate_hz,
                       plan.torque_constant_Nm_per_A);
  }
  return plan.is_on("cia402_can") ? fmt::format(" --counts {}", plan.counts_per_turn)
                                  : std::string();
}

}  // namespace

std::string readme_text(const DevicePlan& plan, const SolvedPlan& solved) {
  std::string text = fmt::format(
      "# A {} on {}\n\n`device.toml` describes the device, `scene.toml` what it touches. Measure "
      "what is "
      "guessed, and write it into\n`device.toml`; a wrong key or unit is answered with the right "
      "line.\n\n"
      "## Before it exists\n```\n"
      "tactus bake device.toml                            # checks everything; device.tactus\n"
      "tactus bake scene.toml                             # scene.tactus\n"
      "tactus inspect device.toml --figure reach.png      # reach, resolution and force\n"
      "tactus inspect device.toml --scene scene.tactus    # whether it reaches the scene\n"
      "tactus sim scene.tactus --device device.toml --output run.csv\n"
      "tactus plot run.csv --scene scene.tactus\n"
      "tactus certify device.toml && tactus bake device.toml   # how stiff its surfaces may be\n"
      "tactus commission device.toml --simulated          # a rehearsal\n```\n",
      plan.title(), plan.drive->words);
  if (!plan.drive->emulated.empty()) {
    std::vector<std::size_t> nodes;
    nodes.reserve(plan.joints());
    for (std::size_t i = 0; i < plan.joints(); ++i) {
      nodes.push_back(plan.is_on("odrive_can") ? i : i + 1);
    }
    const bool is_board = !plan.drive->mechanism.empty();
    fmt::format_to(
        std::back_inserter(text),
        "\nThe same controller program against an emulated device, as root (`tactus emulate {0} "
        "--help` "
        "says how to make its bus):\n```\ntactus emulate {0}{1} --device-file device.toml --hand "
        "pen "
        "&\ntactusd device.tactus scene.tactus\n```\n",
        plan.drive->emulated,
        is_board ? (plan.is_on("haply_serial") ? " --pty" : "")
                 : fmt::format(" --can {} --nodes {}{}", plan.connection, fmt::join(nodes, ","),
                               emulated_options(plan)));
  }
  fmt::format_to(
      std::back_inserter(text),
      "\n## When it exists\nThe drives' own set-up is in `drivers/{}/README.md` of Tactus.\n```\n"
      "tactus doctor device.toml                          # this machine: bus, rights, real time\n"
      "tactus commission device.toml                      # each motor and encoder, gently\n"
      "tactus bake device.toml && tactusd device.tactus scene.tactus\n"
      "tactus home --wait && tactus enable && tactus monitor\n```\n{}",
      plan.drive->name,
      plan.is_on("falcon_usb")
          ? std::string()
          : fmt::format(
                "While homing, hold the handle in the middle of its workspace, at ({:.0f}, {:.0f}, "
                "{:.0f}) mm of the device's frame.\n",
                1e3 * solved.middle_m.x(), 1e3 * solved.middle_m.y(), 1e3 * solved.middle_m.z()));
  return text;
}

}  // namespace tactus::host
