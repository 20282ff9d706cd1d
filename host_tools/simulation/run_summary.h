// The summary of a run: collected tick by tick, printed for people and for programs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/telemetry/record.h"

namespace tactus::host {

inline constexpr std::size_t kTouchFlagCount = 6;

struct RunSummary {
  std::uint64_t ticks = 0;
  double rate_hz = 0.0;
  double wall_s = 0.0;
  std::uint64_t contact_ticks = 0;
  std::uint64_t stick_ticks = 0;
  std::uint64_t slip_ticks = 0;
  double max_force_N = 0.0;      // rendered
  double max_commanded_N = 0.0;  // after the safety limits
  double max_depth_m = 0.0;
  std::uint64_t faults = 0;                                    // every fault bit that was ever set
  double first_fault_s = 0.0;                                  // meaningful if faults is not 0
  std::array<std::uint64_t, 64> limited_ticks{};               // by limit bit
  std::array<std::uint64_t, kTouchFlagCount> flagged_ticks{};  // by touch flag
  std::uint32_t stale_samples = 0;
  firmware::Mode mode = firmware::Mode::init;  // at the end
  std::uint64_t state_hash = 0;                // of the last tick, over the whole run

  [[nodiscard]] double simulated_s() const { return static_cast<double>(ticks) / rate_hz; }
  [[nodiscard]] double ratio() const { return wall_s > 0.0 ? simulated_s() / wall_s : 0.0; }

  void add(const firmware::TelemetryRecord& record);
};

// Several lines, each ending in a newline.
std::string summary_text(const RunSummary& summary);

// One JSON object on one line, with a newline.
std::string summary_json(const RunSummary& summary);

}  // namespace tactus::host
