// Writes what one tool of a run felt into its own files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "host_tools/explain/explainer.h"
#include "host_tools/explain/steps_csv.h"
#include "host_tools/simulation/run_log.h"
#include "host_tools/touch/touch_csv.h"
#include "host_tools/touch/touch_hash.h"
#include "host_tools/touch/touch_summary.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/touch.h"

namespace tactus::host {

// The files of a tool, which are written under their names by close().
struct ToolFiles {
  // One row a tick.
  std::filesystem::path rows;
  // Every step of every tick; empty if they are not wanted.
  std::filesystem::path steps;
  // The state hash of every tick; empty if they are not wanted.
  std::filesystem::path hashes;
};

// Writes each tick of one tool: begin(), the world's touch with the watcher, add().
class ToolRecord {
 public:
  // The tool has this radius, m. Throws InputError if a file cannot be created.
  ToolRecord(const ToolFiles& files, double tool_radius_m);

  // Begins a tick. Returns what must watch it; null if no steps are wanted.
  rendering::TickWatcher* begin();
  // Adds the tick of this number and time (s).
  void add(std::size_t tick, double t_s, const rendering::ToolState& tool,
           const rendering::Touch& touch);
  // Puts the complete files in their places.
  void close();

  [[nodiscard]] const TouchSummary& summary() const { return summary_; }

 private:
  TouchCsv rows_;
  std::optional<StepsCsv> steps_;
  std::optional<HashLog> hashes_;
  TouchHash hash_;
  Explainer explainer_;
  TouchSummary summary_;
};

}  // namespace tactus::host
