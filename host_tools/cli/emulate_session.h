// Parts that all devices of `tactus emulate` share: the options about the machine behind the bus,
// and the run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "drivers/composition/transmission.h"
#include "host_tools/cli/app_forward.h"
#include "host_tools/emulators/machine_options.h"

namespace tactus::host {

// Adds the options of the machine. `machine` must outlive the command line.
void add_machine_options(CLI::App& verb, MachineOptions& machine);

// Takes the priority that --realtime asks for. Call it before the device starts threads.
void take_emulator_priority(const MachineOptions& machine);

void check_emulated_nodes(const std::vector<unsigned>& nodes, unsigned lowest, unsigned highest);

using ConnectDevice =
    std::function<void(EmulatedMachine& machine, std::span<const drivers::Transmission>)>;

// Runs the emulator from its first line of output to its last. `what` names the devices and the
// bus, such as "3 ODrive axes on can0".
void emulate(const MachineOptions& options, const std::string& what, const ConnectDevice& connect);

}  // namespace tactus::host
