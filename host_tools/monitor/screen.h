// The monitor's screen, drawn from what is known of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_tools/monitor/canvas.h"
#include "host_tools/monitor/run_view.h"

namespace tactus::host {

Canvas draw_screen(const RunView& view);

// A line "name: meaning" and a line with the remedy for each fault in the bits, as `tactus faults`
// lists them; the limits follow in one line of names, if there are any. For people.
struct FaultWords {
  std::vector<std::string> faults;    // "joint_limit: joint position outside its range"
  std::vector<std::string> remedies;  // as many: "move back inside by hand, reset"
  std::string limits;                 // "soft_start, limiting_force"
};
FaultWords fault_words(std::uint64_t faults, std::uint64_t limits);

}  // namespace tactus::host
