// Summarises the abilities of a device at its handle in figures and in warnings, for `tactus bake`
// and `tactus inspect`.
#pragma once

#include <string>
#include <vector>

#include "host_tools/reach/reach_map.h"

namespace tactus::host {

// The device over its workspace, the box of the simulated device's stops.
struct ReachSummary {
  // At the middle of the workspace.
  ReachPoint middle;
  // The coarsest and the finest resolution, m.
  double coarsest_m = 0.0;
  double finest_m = 0.0;
  // The weakest and the strongest place, N.
  double weakest_N = 0.0;
  double strongest_N = 0.0;
  // The largest share of its torque that each motor needs for the weights.
  std::array<double, kPlantJoints> weight_share{};
};

// Returns the summary.
ReachSummary summarise_reach(const ReachMap& map);

// Returns a warning for every figure with which the device cannot do what its file asks for, each
// with the key and the remedy: weights against motors, limits against motors, force, resolution.
std::vector<std::string> reach_warnings(const ReachMap& map, const ReachSummary& summary);

// Returns the same warnings for a configuration, or the one that its mechanism reaches nothing or
// is not simulated.
std::vector<std::string> device_warnings(const firmware::DeviceConfig& config);

// Returns the summary in words, several lines.
std::string reach_text(const ReachMap& map, const ReachSummary& summary);

}  // namespace tactus::host
