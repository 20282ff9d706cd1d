// What tactusd lets others see of its run: the recording, the flight recorder, the live socket and
// PlotJuggler, as the command line asks.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "drivers/composed_device.h"
#include "firmware/commands/telemetry_hooks.h"
#include "firmware/configuration/config_state.h"
#include "firmware/control/controller.h"
#include "firmware/flight/flight_writer.h"
#include "firmware/realtime/loop_timing.h"
#include "firmware/tactusd/options.h"
#include "firmware/telemetry/outputs/telemetry_writer.h"
#include "firmware/telemetry/outputs/text_buffer.h"

namespace tactus::firmware {

// What the run is of; all outlives it.
struct RunImages {
  const ControllerConfig& config;  // as the controller was configured
  std::span<const std::byte> device;
  std::span<const std::byte> scene;  // empty: free space
};

class RunTelemetry {
 public:
  RunTelemetry() = default;
  RunTelemetry(const RunTelemetry&) = delete;
  RunTelemetry& operator=(const RunTelemetry&) = delete;
  ~RunTelemetry() = default;

  // Opens what is wanted and starts the thread, before the calling thread becomes a real-time one.
  // False, after telling the user on stderr, if something cannot be had that was asked for.
  bool start(const Options& options, const RunImages& images, std::size_t joints);

  // Real time.
  void publish(Controller& controller, const LoopTick& tick, const drivers::ComposedDevice& device);
  void publish(const TelemetryEvent& event) { writer_.publish(event); }

  // After the loop; tells on stderr what is missing from the recording.
  void stop(const Options& options);

  // For what commands change while the loop runs.
  TelemetrySinks& sinks() { return sinks_; }
  // Writes the last seconds out; from a signal's handler, too.
  void ask_for_flight() { flight_.ask(); }

 private:
  void describe(const Options& options, const RunImages& images, std::size_t joints);
  void attach(const RunImages& images);
  void note(std::string_view key, std::string_view value);
  // Puts what `write` writes where it stays.
  template <class Write>
  std::string_view keep(Write write);
  bool open_live_socket(const Options& options);

  TelemetryWriter writer_;
  FlightWriter flight_;
  TelemetrySinks sinks_{.writer = &writer_, .flight = &flight_};
  std::array<Attachment, 3> images_{};
  RunDescription description_;
  std::array<std::byte, kMaxConfigBytes> config_{};
  std::array<char, 1024> memory_{};
  TextBuffer texts_{memory_};
  std::array<MetadataEntry, 16> info_{};
  std::size_t info_count_ = 0;
};

}  // namespace tactus::firmware
