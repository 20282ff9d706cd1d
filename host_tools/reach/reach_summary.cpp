#include "host_tools/reach/reach_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host_tools/input_error.h"
#include "host_tools/simulation/grid_share.h"

namespace tactus::host {
namespace {

// A motor that holds more than this share of its torque all the time gets warm and has little left.
constexpr double kMuchWeight = 0.5;
// A coarser handle makes stiff surfaces buzz.
constexpr double kCoarse_m = 0.2e-3;
// The smallest excess of a limit over what the drive gives that is told.
constexpr double kRounding = 1.001;

std::string_view effort_key(const ReachMap& map) {
  return firmware::slides(map.config().controller.mechanism) ? "max_effort_N" : "max_effort_Nm";
}

std::string_view effort_unit(const ReachMap& map) {
  return firmware::slides(map.config().controller.mechanism) ? "N" : "N m";
}

// Returns the warnings about one joint.
std::vector<std::string> joint_warnings(const ReachMap& map, const ReachSummary& summary,
                                        std::size_t i) {
  const firmware::JointConfig& joint = map.config().joints[i];
  std::vector<std::string> warnings;
  if (joint.limits.max_effort > kRounding * map.effort(i)) {
    warnings.push_back(fmt::format(
        "joint '{0}': {1} {2:.3g} is more than its motor gives, {3:.3g} {4} (max_torque_Nm of axis "
        "'{5}' times motor_ratio {6:.4g}); the force is clipped there: write {1} = {3:.3g}",
        joint.name, effort_key(map), joint.limits.max_effort, map.effort(i), effort_unit(map),
        joint.motor_name, joint.transmission.motor_ratio));
  }
  const double share = summary.weight_share[i];
  if (share > kMuchWeight) {
    warnings.push_back(fmt::format(
        "joint '{}': the weights of [mechanism] need up to {:.0f} % of the {:.3g} {} that it "
        "gives; "
        "{}: lighten or balance the links, or raise max_torque_Nm, motor_ratio or {}",
        joint.name, 100.0 * share, map.effort(i), effort_unit(map),
        share > 1.0 ? "the arm falls there" : "little is left for touch, and the motor gets warm",
        effort_key(map)));
  }
  return warnings;
}

}  // namespace

ReachSummary summarise_reach(const ReachMap& map) {
  const PlantParameters& plant = map.device().device.plant;
  ReachSummary summary{.middle = map.at(map.device().centre_B).value_or(ReachPoint{})};
  summary.coarsest_m = summary.finest_m = summary.middle.resolution_m;
  summary.weakest_N = summary.strongest_N = summary.middle.force_N;
  constexpr int kSide = 9;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const auto point = map.at(plant.stop_lower_B + grid_share(i, kSide).cwiseProduct(
                                                       plant.stop_upper_B - plant.stop_lower_B));
    if (!point) {
      continue;
    }
    summary.coarsest_m = std::max(summary.coarsest_m, point->resolution_m);
    summary.finest_m = std::min(summary.finest_m, point->resolution_m);
    summary.weakest_N = std::min(summary.weakest_N, point->force_N);
    summary.strongest_N = std::max(summary.strongest_N, point->force_N);
    for (std::size_t joint = 0; joint < summary.weight_share.size(); ++joint) {
      summary.weight_share[joint] =
          std::max(summary.weight_share[joint], point->weight_share[joint]);
    }
  }
  return summary;
}

std::vector<std::string> reach_warnings(const ReachMap& map, const ReachSummary& summary) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < map.config().joint_count; ++i) {
    std::ranges::move(joint_warnings(map, summary, i), std::back_inserter(warnings));
  }
  const double max_force_N = map.config().controller.safety.max_force_N;
  if (max_force_N > summary.strongest_N) {
    warnings.push_back(fmt::format(
        "[controller] max_force_N is {:.3g}, and the motors give at most {:.2g} N in every "
        "direction, {:.2g} N at the weakest place of the workspace; write max_force_N = {:.2g}, or "
        "raise max_torque_Nm, motor_ratio or {}",
        max_force_N, summary.strongest_N, summary.weakest_N, summary.strongest_N, effort_key(map)));
  }
  if (summary.middle.resolution_m > kCoarse_m) {
    warnings.push_back(fmt::format(
        "a count of an encoder moves the handle by {:.2g} mm in the middle of the workspace; "
        "beyond "
        "{:.2g} mm even soft surfaces buzz: take encoders with more counts, or larger ratios",
        1e3 * summary.middle.resolution_m, 1e3 * kCoarse_m));
  }
  return warnings;
}

std::vector<std::string> device_warnings(const firmware::DeviceConfig& config) {
  try {
    const ReachMap map(config);
    return reach_warnings(map, summarise_reach(map));
  } catch (const InputError& error) {
    return {error.what()};
  }
}

std::string reach_text(const ReachMap& map, const ReachSummary& summary) {
  const PlantParameters& plant = map.device().device.plant;
  const Vec3 centre_mm = 1e3 * map.device().centre_B;
  const Vec3 size_mm = 1e3 * (plant.stop_upper_B - plant.stop_lower_B);
  std::string text = fmt::format(
      "workspace {:.0f} x {:.0f} x {:.0f} mm about ({:.0f}, {:.0f}, {:.0f}) mm of the device's "
      "frame\n",
      size_mm.x(), size_mm.y(), size_mm.z(), centre_mm.x(), centre_mm.y(), centre_mm.z());
  fmt::format_to(std::back_inserter(text),
                 "  {:26}{:>10}{:>16}{:>10}\n"
                 "  {:26}{:>10.1f}{:>16.1f}{:>10.1f}\n"
                 "  {:26}{:>10.2f}{:>16.2f}{:>10.2f}\n",
                 "at the handle", "best", "in the middle", "worst", "one count moves it, um",
                 1e6 * summary.finest_m, 1e6 * summary.middle.resolution_m,
                 1e6 * summary.coarsest_m, "force everywhere, N", summary.strongest_N,
                 summary.middle.force_N, summary.weakest_N);
  fmt::format_to(std::back_inserter(text), "mass at the handle {:.3g} kg\n", plant.moving_mass_kg);
  for (std::size_t i = 0; i < map.config().joint_count; ++i) {
    fmt::format_to(std::back_inserter(text),
                   "  {}: gives {:.3g} {}, of which the weights take up to {:.0f} %\n",
                   map.config().joints[i].name, map.effort(i), effort_unit(map),
                   100.0 * summary.weight_share[i]);
  }
  return text;
}

}  // namespace tactus::host
