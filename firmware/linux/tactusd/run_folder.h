// The folder of the command socket and the stop socket.
#pragma once

#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/options.h"

namespace tactus::firmware {

// Returns the folder of the sockets.
const char* run_folder(const Options& options);

// Claims the folder of the sockets. Creates the default folder if it may, because no program must
// run without the stop socket. Returns false after it has printed why to stderr.
bool take_run_folder(const Options& options, ExclusiveUse& exclusive_use);

}  // namespace tactus::firmware
