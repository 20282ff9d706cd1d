// A whole simulated run, from the names and numbers that a user gives to the summary. `tactus sim`
// and the tests of the whole loop use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/simulation/run_summary.h"
#include "host_tools/simulation/simulation.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// The options of a run in the user's words, with the defaults of `tactus sim`.
struct RunOptions {
  // The devices, each one as named_device() takes it. One name with several paths stands for as
  // many devices of that name.
  std::vector<std::string> devices = {"cartesian"};
  // "finger", "pen" or "firm": one for each device, or one for all.
  std::vector<std::string> hands = {"pen"};
  // Chooses the hand's tremor.
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  // The share of the joints' friction that the controller compensates, 0 to 0.9.
  double compensated_share = 0.0;
  // The length of the run; without it the run lasts until the longest wish path ends.
  std::optional<double> seconds;
  // A CSV file with the wish path of each device. For one device it may be missing: a path is then
  // made from the scene.
  std::vector<std::string> paths;
  // True: a scene beyond the certificate of a device file is touched all the same.
  bool allow_uncertified = false;
  // Device faults, each a text that parse_fault() reads.
  std::vector<std::string> faults;
};

// Returns the number of devices. Throws InputError if devices, hands and paths do not go together.
std::size_t device_count(const RunOptions& options);

// Returns the rate of the first device that is described by a file; that of the options if there is
// none. Throws InputError if the file cannot be used.
double described_rate_hz(const RunOptions& options);

// A run that is ready to start.
struct RunPlan {
  // The configuration of each device of the Simulation.
  std::vector<SimulationConfig> devices;
  // The length of the run in simulated time.
  double seconds = 0.0;
  // Text for the user, for example that the path leaves the device's workspace.
  std::vector<std::string> warnings;
};

// Turns options into a plan. `objects` are the scene's, `tool_radius_m` is its tool's. Throws
// InputError for names, numbers and files that cannot be used.
RunPlan plan_run(const RunOptions& options, std::span<const rendering::Object> objects,
                 double tool_radius_m);

// Does the same for a scene, whose effects, bodies and needle the first device's world then has.
// The image must outlive the plan.
RunPlan plan_run(const RunOptions& options, const rendering::SceneImage& scene);

// A fault and the number of its device, 0 for the first.
struct DeviceFaultEvent {
  std::size_t device = 0;
  FaultEvent event;
};
// Returns the fault of a text like `stale@2.5`, `estop@3x10` or `2:lost@4`: the device (the first
// one without it), the fault (stale, nan, estop, lost), its time in s and, after x, how many ticks
// it lasts (1 without it). Throws InputError.
DeviceFaultEvent parse_fault(std::string_view text);

// Receives the simulation before or after every tick.
using TickSink = std::function<void(const Simulation&)>;

// Runs for `seconds` of simulated time and returns the summary of each device. `before` may be
// empty.
std::vector<RunSummary> run(Simulation& simulation, double seconds, double rate_hz,
                            const TickSink& after, const TickSink& before = {});

}  // namespace tactus::host
