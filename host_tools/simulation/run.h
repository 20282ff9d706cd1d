// A whole simulated run, from the names and numbers that a user gives to the summary. `tactus sim`
// and the tests of the whole loop use it.
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
  // One of firmware::kPresetNames.
  std::string device = "cartesian";
  // "finger", "pen" or "firm".
  std::string hand = "pen";
  // Chooses the hand's tremor.
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  // The share of the joints' friction that the controller compensates, 0 to 0.9.
  double compensated_share = 0.0;
  // The length of the run; without it the run lasts until the wish path ends.
  std::optional<double> seconds;
  // A CSV file with the wish path; empty: a path is made from the scene.
  std::string path;
  // Device faults, each a text that parse_fault() reads.
  std::vector<std::string> faults;
};

// A run that is ready to start.
struct RunPlan {
  // The configuration of the Simulation.
  SimulationConfig config;
  // The length of the run in simulated time.
  double seconds = 0.0;
  // Text for the user, for example that the path leaves the device's workspace.
  std::vector<std::string> warnings;
};

// Turns options into a plan. `objects` are the scene's, `tool_radius_m` is its tool's. Throws
// InputError for names, numbers and files that cannot be used.
RunPlan plan_run(const RunOptions& options, std::span<const rendering::Object> objects,
                 double tool_radius_m);

// Returns the fault of a text like `stale@2.5` or `estop@3x10`: the fault (stale, nan, estop,
// lost), its time in s and, after x, how many ticks it lasts (1 without it). Throws InputError.
FaultEvent parse_fault(std::string_view text);

// Receives the simulation after every tick.
using TickSink = std::function<void(const Simulation&)>;

// Runs for `seconds` of simulated time and returns the summary.
RunSummary run(Simulation& simulation, double seconds, double rate_hz, const TickSink& sink);

}  // namespace tactus::host
