// What all devices of `tactus emulate` share: options about what is behind the bus, and the run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "drivers/transmission.h"
#include "host_tools/emulators/machine_options.h"

namespace tactus::host {

// The options live as long as the command line.
void add_machine_options(CLI::App& verb, MachineOptions& machine);

// As --realtime asks; before the device starts threads of its own.
void take_emulator_priority(const MachineOptions& machine);

void check_emulated_nodes(const std::vector<unsigned>& nodes, unsigned lowest, unsigned highest);

using ConnectDevice =
    std::function<void(EmulatedMachine& machine, std::span<const drivers::Transmission>)>;

// From the first line to the last. `what` is emulated where, "3 ODrive axes on can0".
void emulate(const MachineOptions& options, const std::string& what, const ConnectDevice& connect);

}  // namespace tactus::host
