// The common part of all devices of `tactus emulate`: the options about the machine behind the bus,
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

// Takes the priority that --realtime asks for. Call it before the device starts threads, which
// inherit it. Throws InputError.
void take_emulator_priority(const MachineOptions& machine);

// Throws InputError if a node is not an address from `lowest` to `highest`.
void check_emulated_nodes(const std::vector<unsigned>& nodes, unsigned lowest, unsigned highest);

// Connects a device to a machine, by one transmission for each joint.
using ConnectDevice =
    std::function<void(EmulatedMachine& machine, std::span<const drivers::Transmission>)>;

// Makes the machine, connects the device, and runs it until its time is over or the user ends it.
// `what` names the devices and the bus, such as "3 ODrive axes on can0". Throws InputError.
void emulate(const MachineOptions& options, const std::string& what, const ConnectDevice& connect);

}  // namespace tactus::host
