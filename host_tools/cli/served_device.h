// One simulated device of `tactus sim --serve` with the services of tactusd: telemetry and
// commands. Its functions throw InputError if a folder, a socket or a recording cannot be used.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "firmware/commands/command_queue.h"
#include "firmware/configuration/config_state.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/telemetry/explanation_source.h"
#include "firmware/linux/telemetry/places_source.h"
#include "firmware/linux/telemetry/telemetry_writer.h"
#include "hal/clock.h"
#include "host_tools/cli/serve_simulation.h"

namespace tactus::host {

// The recording and the live telemetry of a device.
class ServedTelemetry {
 public:
  // Starts both with what a replay needs: scene and configuration. `device` is 0 for the first one.
  // The scene must outlive the telemetry.
  void start(const Simulation& simulation, std::size_t device, const firmware::SceneStore& scenes,
             double rate_hz, const ServeOptions& options);
  // Publishes the controller's record of the tick that began with `wake`.
  void publish(firmware::Controller& controller, const hal::Wake& wake);
  // Ends the recording.
  void stop();

  // Returns where the controller's events go.
  [[nodiscard]] firmware::TelemetrySinks& sinks() { return sinks_; }
  [[nodiscard]] firmware::TelemetryWriter& writer() { return *writer_; }

 private:
  // The run in words, and the entries that view them.
  struct RunWords {
    std::string rate;
    std::string joints;
    std::string checksum;
    std::string number;
    std::string count;
    std::array<firmware::MetadataEntry, 6> entries;
  };

  // Sends ticks to the port of this device, if there is a first port. Returns 0 or errno.
  int open_udp(std::uint16_t first_port, double rate_hz);
  // Gives the writer the run's properties, its scene and its configuration.
  void describe(const Simulation& simulation, const firmware::SceneStore& scenes, double rate_hz);

  std::size_t device_ = 0;
  std::size_t joints_ = 0;
  RunWords words_;
  std::array<std::byte, firmware::kMaxConfigBytes> config_{};
  // It has megabytes, too many for the stack.
  std::unique_ptr<firmware::TelemetryWriter> writer_ =
      std::make_unique<firmware::TelemetryWriter>();
  firmware::ExplanationSource explanations_;
  firmware::PlacesSource places_;
  firmware::TelemetrySinks sinks_{.writer = writer_.get()};
};

// The services around one device.
class ServedDevice {
 public:
  // Serves the device of that number, 0 for the first, in its folder, which is made.
  ServedDevice(std::size_t number, const std::filesystem::path& run_dir);
  ServedDevice(const ServedDevice&) = delete;
  ServedDevice& operator=(const ServedDevice&) = delete;
  ~ServedDevice() = default;

  void start_telemetry(const Simulation& simulation, const firmware::SceneStore& scenes,
                       double rate_hz, const ServeOptions& options) {
    telemetry_.start(simulation, number_, scenes, rate_hz, options);
  }
  // Starts the threads that listen to requests and to the stop. `scenes` is null but for the first
  // device.
  void start_commands(firmware::SceneStore* scenes, bool allow_inject);
  // Answers the commands of the tick that began with `wake`, and publishes it.
  void publish(firmware::Controller& controller, const hal::Wake& wake) {
    queue_->after_tick(controller);
    telemetry_.publish(controller, wake);
  }
  // Ends both.
  void stop() {
    server_->stop();
    telemetry_.stop();
  }

  [[nodiscard]] firmware::CommandQueue& queue() { return *queue_; }
  [[nodiscard]] ServedTelemetry& telemetry() { return telemetry_; }

 private:
  std::size_t number_;
  std::filesystem::path folder_;
  // Members are destroyed in reverse order: the server goes before what it serves.
  ServedTelemetry telemetry_;
  // Each has megabytes, too many for the stack.
  std::unique_ptr<firmware::CommandQueue> queue_ = std::make_unique<firmware::CommandQueue>();
  std::unique_ptr<firmware::CommandServer> server_;
};

}  // namespace tactus::host
