// Draws the monitor's screen. It needs neither a terminal nor a clock.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_tools/monitor/canvas.h"
#include "host_tools/monitor/run_view.h"

namespace tactus::host {

// Returns the screen for what is known of a run.
Canvas draw_screen(const RunView& view);

// Faults and limits in words for people, from the table that `tactus faults` prints.
struct FaultWords {
  // A line for each fault: "joint_limit: joint position outside its range".
  std::vector<std::string> faults;
  // The remedy of each fault: "move back inside by hand, reset".
  std::vector<std::string> remedies;
  // The names of the limits on one line: "soft_start, limiting_force".
  std::string limits;
};
// Returns the words for the bits of firmware/safety/faults.h.
FaultWords fault_words(std::uint64_t faults, std::uint64_t limits);

}  // namespace tactus::host
