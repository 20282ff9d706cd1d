// A whole run, from the names a user gives to the summary.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/simulation/run_summary.h"
#include "host_tools/simulation/simulation.h"

namespace tactus::host {

// The options of a run in the user's words, with the defaults of `tactus sim`.
struct RunOptions {
  std::string device = "cartesian";  // of firmware::kPresetNames
  std::string hand = "pen";          // or finger, firm
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  double compensated_share = 0.0;   // of the joints' friction, by the controller: 0 to 0.9
  std::optional<double> seconds;    // default: until the wish path ends
  std::string path;                 // CSV file; empty is the path made from the scene
  std::vector<std::string> faults;  // like parse_fault
};

struct RunPlan {
  SimulationConfig config;
  double seconds = 0.0;
  std::vector<std::string> warnings;  // for a user
};

// Throws InputError on names, numbers and files that cannot be used.
RunPlan plan_run(const RunOptions& options, std::span<const rendering::Object> objects,
                 double tool_radius_m);

// `stale@2.5` or `estop@3x10`: a fault (stale, nan, estop, lost), its time in s and, after x, for
// how many ticks (1). Throws InputError.
FaultEvent parse_fault(std::string_view text);

// Called after every tick.
using TickSink = std::function<void(const Simulation&)>;

RunSummary run(Simulation& simulation, double seconds, double rate_hz, const TickSink& sink);

}  // namespace tactus::host
