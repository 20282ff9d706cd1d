// A device whose motors have their power by the board's switch. The switch follows the controller's
// commands. One thread; real time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "hal/bare_metal/board.h"

namespace tactus::firmware {

template <drivers::Device D>
class PoweredDevice {
 public:
  // `device` must outlive it.
  explicit PoweredDevice(D& device) : device_(device) {}

  [[nodiscard]] std::size_t joint_count() const { return device_.joint_count(); }
  void read(drivers::JointSample& sample) { device_.read(sample); }
  // Takes the power before the device sees a command without it, and gives it after a command with
  // it.
  std::uint32_t write(const drivers::JointCommand& command) {
    const bool wants_power = command.enable && !command.power_off;
    if (!wants_power) {
      hal::motors_off();
    }
    const std::uint32_t status = device_.write(command);
    if (wants_power) {
      hal::motors_on();
    }
    return status;
  }
  void clear_faults() { device_.clear_faults(); }

 private:
  D& device_;
};

}  // namespace tactus::firmware
