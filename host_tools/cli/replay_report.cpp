#include "host_tools/cli/replay_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

namespace tactus::host {
namespace {

using Json = nlohmann::ordered_json;

void print_replay_json(const ComparedRun& run) {
  const ReplayResult& result = run.result;
  Json report{{"equal", !result.difference.has_value()},
              {"first_tick", result.first_tick},
              {"equal_ticks", result.ticks},
              {"equal_s", static_cast<double>(result.ticks) / run.rate_hz},
              {"cut", result.cut}};
  if (const auto& difference = result.difference) {
    report["difference"] = {{"tick", difference->tick},
                            {"device", difference->device + 1},
                            {"field", difference->field},
                            {"recorded", difference->recorded},
                            {"replayed", difference->replayed}};
  }
  fmt::print("{}\n", report.dump());
}

}  // namespace

void print_replay(const ComparedRun& run, bool as_json) {
  if (as_json) {
    print_replay_json(run);
    return;
  }
  const ReplayResult& result = run.result;
  if (result.ticks > 0) {
    fmt::print("ticks {} to {} ({:.3f} s): every hash equal\n", result.first_tick,
               result.first_tick + result.ticks - 1,
               static_cast<double>(result.ticks) / run.rate_hz);
  }
  if (result.cut) {
    fmt::print("the recording was cut off: its last ticks are missing\n");
  }
  if (const auto& difference = result.difference) {
    const std::string device =
        run.devices == 1 ? "" : fmt::format(" of device {}", difference->device + 1);
    fmt::print("tick {} ({:.3f} s){} differs: {} was {} and is now {}\n", difference->tick,
               static_cast<double>(difference->tick) / run.rate_hz, device, difference->field,
               difference->recorded, difference->replayed);
  }
}

void print_change(const WhatIfSummary& summary, bool as_json) {
  if (as_json) {
    Json report{
        {"recorded", {{"largest_N", summary.most_recorded_N}, {"mean_N", summary.mean_recorded_N}}},
        {"changed", {{"largest_N", summary.most_changed_N}, {"mean_N", summary.mean_changed_N}}},
        {"farthest_apart_N", summary.most_apart_N},
        {"farthest_apart_s", summary.most_apart_s}};
    if (summary.fault_s) {
      report["changed_run_faults_s"] = *summary.fault_s;
    }
    if (summary.scene_changed_s) {
      report["scene_changes_s"] = *summary.scene_changed_s;
    }
    fmt::print("{}\n", report.dump());
    return;
  }
  fmt::print(
      "force on the hand, N      as recorded   as changed\n"
      "largest                  {:12.3f} {:12.3f}\n"
      "mean while felt          {:12.3f} {:12.3f}\n"
      "farthest apart: {:.3f} N at {:.3f} s\n",
      summary.most_recorded_N, summary.most_changed_N, summary.mean_recorded_N,
      summary.mean_changed_N, summary.most_apart_N, summary.most_apart_s);
  if (summary.fault_s) {
    fmt::print("the changed run ends in a fault at {:.3f} s, the recorded one does not\n",
               *summary.fault_s);
  }
  if (summary.scene_changed_s) {
    fmt::print("up to {:.3f} s, where the scene changed\n", *summary.scene_changed_s);
  }
}

}  // namespace tactus::host
