// Lets the commands `record` and `scene` reach the telemetry's writer.
#pragma once

#include "firmware/commands/command_desk.h"
#include "firmware/commands/command_server.h"
#include "firmware/flight/flight_writer.h"
#include "firmware/telemetry/outputs/telemetry_writer.h"

namespace tactus::firmware {

// Whom it reaches; all outlives the server.
struct TelemetrySinks {
  TelemetryWriter* writer = nullptr;
  FlightWriter* flight = nullptr;  // null: there is none
};

// Recordings are plain names in the program's working folder, and replace no file: whoever may
// connect shall not write where the program may. A scene of more than 64 MiB is not put into
// recordings.
RunHooks telemetry_hooks(TelemetrySinks& sinks);

// What took effect goes into the telemetry.
EventSink telemetry_events(TelemetrySinks& sinks);

}  // namespace tactus::firmware
