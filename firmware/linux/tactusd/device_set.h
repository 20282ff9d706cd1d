// All devices of a run of tactusd with their controller, scene and flight recorder.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/flight/flight_writer.h"
#include "firmware/linux/tactusd/exclusive_use.h"
#include "firmware/linux/tactusd/options.h"
#include "firmware/linux/tactusd/run_device.h"
#include "firmware/linux/tactusd/startup_array.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// The devices of one run. What each device beyond the first needs is made when their number is
// known, so that a run of one device has none of it. Functions that return bool return false after
// they have printed why to stderr. All but all(), controller() and stop_motors() are for the start
// and the end of the program, and are not real time. It belongs into static storage.
class DeviceSet {
 public:
  // Makes the devices' storage and the controller. Call first.
  bool make(const Options& options);
  // Reads all files, checks that the devices can work beside each other, and opens all boards. The
  // store owns the scene.
  bool open(const Options& options, ExclusiveUse& exclusive_use, SceneStore& scenes);
  // Starts the telemetry of all devices, and the flight recorder. `scene` is empty for free space.
  bool start_telemetry(const Options& options, std::span<const std::byte> scene);
  // Opens the sockets of all devices; those of the first one reach the scene.
  bool start_commands(const Options& options, SceneStore& scenes);
  // Lets the boards begin.
  void start_motors() const;

  // Takes the torque away at once. The handler of crashes calls it, too.
  void stop_motors() const;
  // Returns false if a command thread hangs, see CommandServer::stop.
  bool stop_commands() const;
  void stop_telemetry();
  // Prints the faults of the devices that are in mode `fault`, which must be stopped.
  void explain_faults(const Options& options) const;

  // Returns the devices in the order of the controller's.
  [[nodiscard]] std::span<RunDevice* const> all() const { return std::span(all_).first(count_); }
  [[nodiscard]] Controller& controller() { return *controller_; }
  [[nodiscard]] FlightWriter& flight() { return flight_; }

 private:
  // Checks that no two devices use the same hardware.
  [[nodiscard]] bool go_together(const Options& options) const;

  // The storage of the devices beyond the first one.
  struct Further {
    StartupArray<RunDevice> run;
    StartupArray<FlightCompanion> flight;
    StartupArray<DeviceController> controllers;
    StartupArray<rendering::ToolSlot> tools;
    // The flight recorder's room for the states of all devices.
    StartupArray<std::byte> states;

    // Makes room for a run of so many devices. Returns 0 or errno.
    int make(std::size_t devices);
  };

  RunDevice first_;
  Further further_;
  std::optional<Controller> made_controller_;
  // The controller of make(); null before.
  Controller* controller_ = nullptr;
  FlightWriter flight_;
  std::array<RunDevice*, rendering::kMaxTools> all_{};
  std::array<TelemetryWriter*, rendering::kMaxTools> companions_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::firmware
