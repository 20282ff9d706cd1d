// The folders that hold the sockets of a run: that of the command line for the first device, and
// one in it for each further device, 2 and so on.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"

namespace tactus::firmware {

// A path, ended by a zero.
using FolderPath = std::array<char, kMaxMessage>;

// Returns the folder of the sockets of the device of that number, 0 for the first.
FolderPath run_folder(const Options& options, std::size_t device);

// Claims the folder of the sockets, and makes those of further devices, with its group and rights.
// Creates the default folder if it may, because no program must run without the stop socket.
// Returns false after it has printed why to stderr.
bool take_run_folder(const Options& options, ExclusiveUse& exclusive_use);

// Lets programs name the devices: links the names of their images in the folder of the sockets.
// Returns false after it has printed why to stderr.
bool name_devices(const Options& options);

}  // namespace tactus::firmware
