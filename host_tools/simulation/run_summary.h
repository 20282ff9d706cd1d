// The summary of a run: collected tick by tick, then printed for people or for programs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/telemetry/record.h"

namespace tactus::host {

// How many flags a touch can raise (rendering::kTouch...).
inline constexpr std::size_t kTouchFlagCount = 7;

// Counts and extremes over all ticks of a run.
struct RunSummary {
  // How many ticks the run had, and how many of them make a simulated second.
  std::uint64_t ticks = 0;
  double rate_hz = 0.0;
  // How long the run took on this machine.
  double wall_s = 0.0;
  // Ticks in which the proxy touched a surface, and among them those in which friction held or
  // slid.
  std::uint64_t contact_ticks = 0;
  std::uint64_t stick_ticks = 0;
  std::uint64_t slip_ticks = 0;
  // The largest rendered force, before the safety limits.
  double max_force_N = 0.0;
  // The largest force after the safety limits.
  double max_commanded_N = 0.0;
  // The largest penetration depth.
  double max_depth_m = 0.0;
  // Every fault bit that was ever set.
  std::uint64_t faults = 0;
  // When the first fault occurred; meaningful if `faults` is not 0.
  double first_fault_s = 0.0;
  // For each limit bit, in how many ticks it was set.
  std::array<std::uint64_t, 64> limited_ticks{};
  // For each touch flag, in how many ticks it was raised.
  std::array<std::uint64_t, kTouchFlagCount> flagged_ticks{};
  // How many samples of the device were stale.
  std::uint32_t stale_samples = 0;
  // The controller's mode after the last tick.
  firmware::Mode mode = firmware::Mode::init;
  // The hash after the last tick, which depends on all ticks before.
  std::uint64_t state_hash = 0;

  // Returns the simulated time.
  [[nodiscard]] double simulated_s() const { return static_cast<double>(ticks) / rate_hz; }
  // Returns the simulated seconds for each second of wall time; 0 before the run has taken time.
  [[nodiscard]] double ratio() const { return wall_s > 0.0 ? simulated_s() / wall_s : 0.0; }

  // Adds one tick.
  void add(const firmware::TelemetryRecord& record);
};

// Returns the summary for a person, several lines, each ending in a newline.
std::string summary_text(const RunSummary& summary);

// Returns the summary as one JSON object on one line, with a newline.
std::string summary_json(const RunSummary& summary);

}  // namespace tactus::host
