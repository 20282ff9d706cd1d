// Reaches the controller of a verb: by the sockets of a program on this machine, or over the line
// to a board.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "host_tools/cli/run_folder_option.h"
#include "host_tools/serial/line_session.h"

namespace tactus::host {

// The parts of a board that a verb needs. Fewer take less time on the line.
struct LineNeeds {
  // The live socket has ticks.
  bool ticks = false;
  // Objects have names.
  bool images = false;
};

// A verb's work. It gets the folder of the sockets, and the line to a board or nullptr.
using ControllerWork =
    std::function<void(const std::filesystem::path& folder, const LineSession* line)>;

// Does the work with the controller that the options name. Throws what it throws, and
// UnreachableError if no board answers or the line is lost meanwhile.
void with_controller(const RunFolderOption& option, const LineNeeds& needs,
                     const ControllerWork& work);

// Returns the options of a gateway: the place, and the progress of images on a terminal.
GatewayOptions gateway_options(const std::string& place);

}  // namespace tactus::host
