// Lets the commands `record` and `scene` reach the telemetry's writer.
#pragma once

#include "firmware/commands/command_desk.h"
#include "firmware/commands/command_server.h"
#include "firmware/telemetry/outputs/telemetry_writer.h"

namespace tactus::firmware {

// Recordings are plain names in the program's working folder, and replace no file: whoever may
// connect shall not write where the program may. A scene of more than 64 MiB is not put into
// recordings. The writer outlives the server.
RunHooks telemetry_hooks(TelemetryWriter& writer);

// What took effect goes into the telemetry.
EventSink telemetry_events(TelemetryWriter& writer);

}  // namespace tactus::firmware
