// Everything of one device in a run of tactusd: its inputs, boards, telemetry and commands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "drivers/composition/composed_device.h"
#include "firmware/commands/command_queue.h"
#include "firmware/control/controller.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/realtime/watchdog_output.h"
#include "firmware/linux/tactusd/device_inputs.h"
#include "firmware/linux/tactusd/linux_boards.h"
#include "firmware/linux/tactusd/options.h"
#include "firmware/linux/tactusd/run_telemetry.h"

namespace tactus::firmware {

// One device of the run. Its start functions return false after they have printed why to stderr,
// and are not real time. It belongs into static storage, or into a StartupArray.
class RunDevice {
 public:
  // Reads the device's files and configures the controller. `number` is 0 for the first device.
  bool load(const Options& options, std::size_t number, Controller& controller);
  // Opens the boards and the watchdog's line.
  bool open_boards(const Options& options);
  // Starts the recordings and the live telemetry. `scene` is empty for free space.
  bool start_telemetry(const Options& options, const Controller& controller,
                       std::span<const std::byte> scene);
  // Opens the command socket and the stop socket. `scenes` is null but for the first device.
  bool start_commands(const Options& options, SceneStore* scenes);

  // Returns false if the command thread hangs, see CommandServer::stop.
  bool stop_commands() { return !commands_ || commands_->stop(); }
  // Prints the faults and the joint in trouble if the device is in mode `fault`. `name` precedes
  // them; empty for a controller of one device.
  void explain_fault(const Controller& controller, std::string_view name) const;
  // Takes the torque away at once. The handler of crashes calls it, too.
  void stop_motors() {
    if (device_ != nullptr) {
      device_->stop();
    }
  }

  // The device of the boards. Call after open_boards().
  [[nodiscard]] drivers::ComposedDevice& device() { return *device_; }
  [[nodiscard]] const DeviceConfig& config() const { return inputs_.config(); }
  [[nodiscard]] hal::LinuxClock& clock() { return boards_.clock(); }
  [[nodiscard]] WatchdogOutput& watchdog() { return watchdog_; }
  [[nodiscard]] CommandQueue& queue() { return queue_; }
  [[nodiscard]] RunTelemetry& telemetry() { return telemetry_; }

  // Publishes the tick that has ended. Real time: for the loop's thread.
  void publish(Controller& controller, const LoopTick& tick) {
    queue_.after_tick(controller);
    telemetry_.publish(controller, tick, *device_);
  }

 private:
  std::size_t number_ = 0;
  DeviceInputs inputs_;
  LinuxBoards boards_;
  std::optional<drivers::ComposedDevice> made_device_;
  // The device of open_boards(); null before.
  drivers::ComposedDevice* device_ = nullptr;
  WatchdogOutput watchdog_;
  RunTelemetry telemetry_;
  CommandQueue queue_;
  std::optional<CommandServer> commands_;
};

}  // namespace tactus::firmware
