// The options of `tactus emulate` that describe the device behind the bus, in the user's words.
// They are the same for every kind of bus.
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

// The options with their defaults. Lists of numbers have one for all joints, or one for each.
struct MachineOptions {
  // One of firmware::kPresetNames.
  std::string mechanism;
  // A device file or image that describes the mechanism, and the ratios, directions and offsets of
  // its joints, in place of the options for them; empty: none.
  std::string device_file;
  // Turns of a drive's shaft for a turn of its joint.
  std::vector<double> ratios = {1.0};
  // 1 if shaft and joint turn the same way, else -1.
  std::vector<double> directions = {1.0};
  // Empty: as `directions`.
  std::vector<double> motor_directions;
  // The position of the joint where its encoder reads 0, rad or m.
  std::vector<double> offsets = {0.0};
  // "finger", "pen", "firm" or "none".
  std::string hand = "none";
  // When the hand lets go of the handle, s after the start.
  double let_go_s = std::numeric_limits<double>::infinity();
  // True: the links weigh nothing.
  bool balanced = false;
  // A CSV file with the hand's wish; empty: the hand holds the origin.
  std::string path;
  // The path's origin in the mechanism's base frame; empty: the middle of the workspace.
  std::vector<double> origin_m;
  // Planned faults, as parse_planned_fault() reads them.
  std::vector<std::string> faults;
  // The CSV file for the true state; empty: none.
  std::string truth;
  // Chooses the hand's tremor and the bits that the fault `corrupted` inverts.
  std::uint32_t seed = 1;
  // The SCHED_FIFO priority, 1 to 99; 0: that of an ordinary program.
  int priority = 0;
  // The step and the length of the run.
  RealTimeOptions run;
};

// These functions turn the options into configurations. They throw InputError for names, numbers
// and files that cannot be used.
EmulatedMachineConfig machine_config(const MachineOptions& options);
// Returns one transmission for each joint.
std::vector<drivers::Transmission> transmissions(const MachineOptions& options, std::size_t joints);
// Returns the planned faults and how the true state is recorded.
EmulatedRunConfig run_config(const MachineOptions& options);

}  // namespace tactus::host
