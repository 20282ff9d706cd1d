// Connects the commands `record` and `scene` to the telemetry's writers. The hooks run in the
// command thread, the receiver of events in the loop's.
#pragma once

#include <span>

#include "firmware/commands/command_queue.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/flight/flight_writer.h"
#include "firmware/linux/telemetry/telemetry_writer.h"

namespace tactus::firmware {

// The writers that commands reach. They must outlive the server.
struct TelemetrySinks {
  TelemetryWriter* writer = nullptr;
  // The flight recorder's writer; null: there is none.
  FlightWriter* flight = nullptr;
  // The writers of the controller's other devices, which record changes of the scene, too.
  std::span<TelemetryWriter* const> companions;
};

// Returns hooks for `record` and `scene`. A recording's file is a plain name in the program's
// working folder and never replaces a file, so that a client cannot write wherever the program may.
// A scene larger than 64 MiB is left out of recordings.
RunHooks telemetry_hooks(TelemetrySinks& sinks);

// Returns a receiver that writes each event into the telemetry.
EventSink telemetry_events(TelemetrySinks& sinks);

}  // namespace tactus::firmware
