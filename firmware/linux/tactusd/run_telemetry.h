// The telemetry of a device in a run of tactusd, as the command line asks for it: the recording,
// the flight recorder, the live socket and the JSON datagrams for PlotJuggler.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "drivers/composition/composed_device.h"
#include "firmware/configuration/config_state.h"
#include "firmware/control/controller.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/flight/flight_writer.h"
#include "firmware/linux/realtime/loop_timing.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"
#include "firmware/linux/telemetry/explanation_source.h"
#include "firmware/linux/telemetry/places_source.h"
#include "firmware/linux/telemetry/telemetry_writer.h"
#include "firmware/linux/telemetry/text_buffer.h"

namespace tactus::firmware {

// The inputs of the device's run, for its recordings. They must outlive the telemetry.
struct RunImages {
  // The controller's configuration.
  const ControllerConfig& config;
  // The device image.
  std::span<const std::byte> device;
  // The scene image; empty: free space.
  std::span<const std::byte> scene;
};

// The outputs of one device, in static storage.
class RunTelemetry {
 public:
  RunTelemetry() = default;
  RunTelemetry(const RunTelemetry&) = delete;
  RunTelemetry& operator=(const RunTelemetry&) = delete;
  ~RunTelemetry() = default;

  // Opens the outputs of the device of that number, 0 for the first, and starts the thread. Call
  // before the calling thread becomes a real-time thread. Returns false after it has printed why to
  // stderr.
  bool start(const Options& options, std::size_t device, const RunImages& images,
             std::size_t joints);

  // Returns the content of the device's flight files, after start().
  [[nodiscard]] FlightPlan flight_plan(const Options& options) const;
  // Gives the ticks to the flight recorder: those of the first device to its writer, those of
  // another one to its companion. Call before the loop starts.
  void fly(FlightWriter& writer) { sinks_.flight = &writer; }
  void fly(FlightCompanion& companion) { companion_ = &companion; }
  // Lets changes of the scene reach the telemetry of the other devices; for the first one.
  void tell(std::span<TelemetryWriter* const> companions) { sinks_.companions = companions; }

  // Publishes the device's tick that has ended. Real time: for the loop's thread.
  void publish(Controller& controller, const LoopTick& tick, const drivers::ComposedDevice& device);

  // Ends the outputs after the loop. Prints to stderr how much is missing from the recording, if
  // anything is.
  void stop();

  // Returns the writers that commands may switch while the loop runs.
  TelemetrySinks& sinks() { return sinks_; }
  [[nodiscard]] TelemetryWriter& writer() { return writer_; }

 private:
  // Makes the metadata of the recordings.
  void describe(const Options& options, const RunImages& images, std::size_t joints);
  // Notes which of the devices this one is, if there are several.
  void describe_device(const Options& options);
  // Attaches images and configuration to the recordings.
  void attach(const RunImages& images);
  // Adds an entry of the metadata. Both texts must stay.
  void note(std::string_view key, std::string_view value);
  // Copies the text that `write` adds to the buffer into `memory_` and returns a view of it.
  template <class Write>
  std::string_view keep(Write write);
  // These return false after they have printed why to stderr.

  bool open_live_socket(const Options& options);
  bool open_udp(const Options& options, double rate_hz);
  bool open_recording(const Options& options);

  // The number of the device, 0 for the first.
  std::size_t device_ = 0;
  TelemetryWriter writer_;
  ExplanationSource explanations_;
  PlacesSource places_;
  // Null but for devices beyond the first.
  FlightCompanion* companion_ = nullptr;
  TelemetrySinks sinks_{.writer = &writer_};
  // The path of the recording; empty: none.
  std::array<char, kMaxMessage> record_{};
  double rate_hz_ = 0.0;
  std::array<Attachment, 3> images_{};
  std::size_t image_count_ = 0;
  RunDescription description_;
  std::array<std::byte, kMaxConfigBytes> config_{};
  // The texts of the metadata that are made here.
  std::array<char, 1024> memory_{};
  TextBuffer texts_{memory_};
  std::array<MetadataEntry, 16> info_{};
  std::size_t info_count_ = 0;
};

}  // namespace tactus::firmware
