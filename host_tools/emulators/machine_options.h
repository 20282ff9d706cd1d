// The options of `tactus emulate` about the device behind the bus, for any bus, in the user's
// words.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "drivers/composition/transmission.h"
#include "host_tools/emulators/emulated_machine.h"
#include "host_tools/emulators/emulated_run.h"
#include "host_tools/emulators/real_time_run.h"

namespace tactus::host {

struct MachineOptions {
  std::string mechanism;               // of firmware::kPresetNames
  std::vector<double> ratios = {1.0};  // each list: one for all joints, or one for each
  std::vector<double> directions = {1.0};
  std::vector<double> motor_directions;  // empty: as `directions`
  std::vector<double> offsets = {0.0};
  std::string hand = "none";  // finger, pen, firm or none
  double let_go_s = std::numeric_limits<double>::infinity();
  bool balanced = false;         // the links weigh nothing
  std::string path;              // CSV of the hand's wish; empty: it holds the origin
  std::vector<double> origin_m;  // of the path, in the mechanism's frame; empty: workspace's middle
  std::vector<std::string> faults;
  std::string truth;  // CSV file to write; empty: none
  std::uint32_t seed = 1;
  int priority = 0;  // SCHED_FIFO, 1 to 99; 0: as every program
  RealTimeOptions run;
};

// The following functions throw InputError on names, numbers and files that cannot be used.
EmulatedMachineConfig machine_config(const MachineOptions& options);
// Returns a transmission for each joint.
std::vector<drivers::Transmission> transmissions(const MachineOptions& options, std::size_t joints);
EmulatedRunConfig run_config(const MachineOptions& options);

}  // namespace tactus::host
