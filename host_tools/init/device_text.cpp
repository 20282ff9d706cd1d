#include "host_tools/init/device_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace tactus::host {
namespace {

// Returns the key of a joint with the unit of its kind: lower_rad or lower_m.
std::string joint_key(const DevicePlan& plan, std::string_view base) {
  return fmt::format("{}_{}", base, plan.slides() ? "m" : "rad");
}

// Returns the lines about lengths and weights that only this mechanism has.
std::string own_lines(const DevicePlan& plan) {
  const std::vector<double>& lengths_m = plan.lengths_m;
  const double kg = plan.handle_kg;
  if (plan.mechanism->name == "serial_arm") {
    return fmt::format(
        "tool_kg = {}\n"
        "# The weights of the links, and where their centres are, from the inner joint on:\n"
        "# upper_kg = 0.1\n# upper_centre_m = {:.4g}\n# forearm_kg = 0.06\n"
        "# forearm_centre_m = {:.4g}\n",
        kg, 0.5 * lengths_m[0], 0.5 * lengths_m[1]);
  }
  if (plan.mechanism->name == "pantograph") {
    return fmt::format(
        "tool_kg = {}\n"
        "# The weights of each of two links, if the device does not lie flat:\n"
        "# proximal_kg = 0.02\n# proximal_centre_m = {:.4g}\n",
        kg, 0.5 * lengths_m[1]);
  }
  if (plan.mechanism->name == "paddle") {
    return fmt::format(
        "# With its centre of mass at the handle.\npaddle_kg = {}\n"
        "paddle_centre_m = {}\n",
        kg, lengths_m[0]);
  }
  if (plan.mechanism->name == "cartesian") {
    return fmt::format(
        "# What moves with each axis, together with the axes that it carries.\n"
        "carried_kg = [{0}, {0}, {0}]\n",
        kg);
  }
  std::string text = fmt::format("platform_kg = {}\n", kg);
  if (!plan.is_on("falcon_usb")) {
    // Level arms are in the middle of their travel.
    const double across_m = lengths_m[2] + lengths_m[0] - lengths_m[3];
    const double square = lengths_m[1] * lengths_m[1] - across_m * across_m;
    fmt::format_to(std::back_inserter(text),
                   "# Hinges in the middle of arms and platform, and no end pieces.\n"
                   "hinge_offset_m = 0\nbase_tangent_m = 0\nplatform_tangent_m = 0\n"
                   "# A height inside the workspace.\nnominal_height_m = {:.4g}\n",
                   square > 0.0 ? std::sqrt(square) : 0.7 * lengths_m[1]);
  }
  return text;
}

std::string mechanism_lines(const DevicePlan& plan) {
  std::string text = fmt::format(
      "# The mechanism: {}.\n# Lengths are in m, masses in kg; host_tools/bake/README.md has all "
      "keys.\n"
      "[mechanism]\nkind = \"{}\"\n",
      plan.mechanism->words, plan.mechanism->kind);
  for (std::size_t i = 0; i < plan.lengths_m.size(); ++i) {
    const PlannedLength& length = plan.mechanism->lengths[i];
    if (!length.key.empty()) {
      fmt::format_to(std::back_inserter(text), "{} = {}  # {}\n", length.key, plan.lengths_m[i],
                     length.words);
    }
  }
  return text + own_lines(plan);
}

std::string controller_lines(const DevicePlan& plan, const SolvedPlan& solved) {
  return fmt::format(
      "\n[controller]\nrate_hz = {}\n"
      "# The origin of scenes in the device's frame: the middle of the workspace.\n"
      "workspace_origin_m = [{:.4f}, {:.4f}, {:.4f}]\n"
      "# The force that the motors give everywhere in the workspace.\nmax_force_N = {:.2g}\n",
      plan.rate_hz, solved.middle_m.x(), solved.middle_m.y(), solved.middle_m.z(), solved.force_N);
}

// Returns the connections.
std::string connection_lines(const DevicePlan& plan) {
  if (plan.is_on("falcon_usb")) {
    return fmt::format(
        "\n[[connection]]\nname = \"usb\"\nkind = \"falcon_usb\"\n{}"
        "# Nobody has shown what its motors do when the host falls silent. Keep its power plug "
        "within reach.\n"
        "unproven_watchdog = true\n",
        plan.connection == "-" ? std::string() : fmt::format("serial = \"{}\"\n", plan.connection));
  }
  if (plan.is_on("haply_serial")) {
    return fmt::format(
        "\n[[connection]]\nname = \"usb\"\nkind = \"haply_serial\"\nport = \"{}\"\n"
        "# The board has no watchdog: its motors keep their last torque. Keep its power plug "
        "within reach.\n"
        "unproven_watchdog = true\n",
        plan.connection);
  }
  if (!plan.is_on("gpio_axis")) {
    return fmt::format("\n[[connection]]\nname = \"bus\"\nkind = \"can\"\ninterface = \"{}\"\n",
                       plan.connection);
  }
  std::string text;
  for (std::size_t i = 0; i < plan.joints(); ++i) {
    fmt::format_to(std::back_inserter(text),
                   "\n[[connection]]\nname = \"board {}\"\nkind = \"gpio\"\nchip = \"{}\"\n"
                   "pwm_folder = \"/sys/class/pwm/pwmchip0\"\npwm_channel = {}\n",
                   i, plan.connection, i);
  }
  return text;
}

// Returns the keys of an axis that its driver alone has.
std::string driver_lines(const DevicePlan& plan, std::size_t i) {
  const std::string torque = fmt::format("max_torque_Nm = {}\n", plan.torque_Nm);
  if (plan.is_on("odrive_can")) {
    return fmt::format("node_id = {}\n{}", i, torque);
  }
  if (plan.is_on("moteus_canfd")) {
    return fmt::format("servo_id = {}\n{}", i + 1, torque);
  }
  if (plan.is_on("cia402_can")) {
    return fmt::format("node = {}\n{}{}counts_per_turn = {}\nperiod_s = {:.6g}\n", i + 1,
                       i == 0 ? "" : "leads_bus = false\n", torque, plan.counts_per_turn,
                       1.0 / plan.rate_hz);
  }
  if (plan.is_on("vesc_can")) {
    return fmt::format(
        "vesc_id = {}\n{}torque_constant_Nm_per_A = {}\noffers_position = true\n"
        "status_period_s = {:.6g}\n",
        i + 1, torque, plan.torque_constant_Nm_per_A, 1.0 / plan.rate_hz);
  }
  if (plan.is_on("gpio_axis")) {
    constexpr std::size_t kLines = 5;
    return fmt::format(
        "# Lines of the chip: change them to your wiring.\nencoder_a = \"{}\"\nencoder_b = \"{}\"\n"
        "direction = \"{}\"\nenable = \"{}\"\n"
        "# A monostable on this line takes the motor's power when the program dies.\n"
        "heartbeat = \"{}\"\ncounts_per_turn = {}\nmax_speed_rad_per_s = 200\n"
        "full_duty_torque_Nm = {}\n{}",
        kLines * i, kLines * i + 1, kLines * i + 2, kLines * i + 3, kLines * i + 4,
        plan.counts_per_turn, plan.torque_Nm, torque);
  }
  return fmt::format("number = {}\n", i);
}

std::string axis_lines(const DevicePlan& plan, std::size_t i) {
  const bool is_gpio = plan.is_on("gpio_axis");
  const bool is_board = !plan.drive->mechanism.empty();
  const std::string line = is_gpio ? fmt::format("board {}", i) : is_board ? "usb" : "bus";
  return fmt::format("\n[[axis]]\nname = \"drive {}\"\ndriver = \"{}\"\nconnection = \"{}\"\n{}", i,
                     plan.drive->name, line, driver_lines(plan, i));
}

std::string joint_lines(const DevicePlan& plan, const SolvedPlan& solved, std::size_t i) {
  std::string text = fmt::format(
      "\n[[joint]]\nname = \"{}\"\nmotor = \"drive {}\"\nmotor_ratio = {}\nencoder_ratio = {}\n",
      plan.mechanism->joints[i], i, plan.ratios[i], plan.ratios[i]);
  if (plan.is_on("falcon_usb")) {
    text += "reference = \"board\"\n";
  } else {
    fmt::format_to(std::back_inserter(text), "reference = \"known_pose\"\n{} = {:.4f}\n",
                   joint_key(plan, "reference"), solved.joints[static_cast<Eigen::Index>(i)]);
  }
  if (plan.slides()) {
    const double half_m = 0.5 * plan.lengths_m[0];
    fmt::format_to(std::back_inserter(text), "lower_m = {:.4g}\nupper_m = {:.4g}\n", -half_m,
                   half_m);
  }
  fmt::format_to(std::back_inserter(text), "{} = {:.4g}\n",
                 plan.slides() ? "max_effort_N" : "max_effort_Nm", plan.torque_Nm * plan.ratios[i]);
  return text;
}

// Returns [plant]: the encoders that only the drives know.
std::string plant_lines(const DevicePlan& plan) {
  std::string text =
      "\n# For the simulation, certify and commission alone; the controller does not use "
      "it.\n[plant]\n";
  if (!plan.is_on("cia402_can") && !plan.is_on("gpio_axis")) {
    const double ratio = *std::ranges::min_element(plan.ratios);
    fmt::format_to(std::back_inserter(text),
                   "# One count of {} a turn, at the joint.\nencoder_resolution_{} = {:.4g}\n",
                   plan.counts_per_turn, plan.slides() ? "m" : "rad",
                   2.0 * std::numbers::pi / (plan.counts_per_turn * ratio));
  }
  return text +
         fmt::format(
             "# Measured values are better than what follows from [mechanism] and the preset:\n"
             "# moving_mass_kg = {}\n# viscous_Ns_per_m = 0.5\n# delay_ticks = 1\n",
             plan.handle_kg);
}

}  // namespace

std::string device_text(const DevicePlan& plan, const SolvedPlan& solved) {
  std::string text = fmt::format(
      "# A {} on {}, as tactus init arm wrote it. README.md has the next steps.\n"
      "name = \"My {}\"\n\n",
      plan.title(), plan.drive->words, plan.title());
  text += mechanism_lines(plan);
  text += controller_lines(plan, solved);
  text += connection_lines(plan);
  for (std::size_t i = 0; i < plan.joints(); ++i) {
    text += axis_lines(plan, i);
  }
  text += plan.is_on("falcon_usb")
              ? "\n# The board finds its own reference when the grip is pulled out and pushed in.\n"
              : "\n# While homing, hold the handle in the middle of its workspace: these are the "
                "joints there. Another pose that\n# you can repeat does as well; "
                "host_tools/bake/README.md has the other references.\n";
  for (std::size_t i = 0; i < plan.joints(); ++i) {
    text += joint_lines(plan, solved, i);
  }
  return text + plant_lines(plan);
}

std::string scene_text(const DevicePlan& plan, const SolvedPlan& solved) {
  if (plan.joints() == 1) {
    return "# A soft wall on the right of the middle.\n[tool]\nradius_m = 0.002\n\n[[object]]\n"
           "name = \"wall\"\nprimitive = \"box\"\nsize_m = [0.02, 0.1, 0.1]\n"
           "position_m = [0.015, 0.0, 0.0]\nstiffness_N_per_m = 100.0\n";
  }
  return fmt::format(
      "# A soft box in the middle of the workspace.\n[tool]\nradius_m = 0.002\n\n"
      "[[object]]\nname = \"box\"\nprimitive = \"box\"\n"
      "size_m = [{0:.4f}, {0:.4f}, {0:.4f}]\nstiffness_N_per_m = 100.0\n"
      "friction = {{ static = 0.4, dynamic = 0.3 }}\n",
      0.8 * solved.half_m);
}

}  // namespace tactus::host
