// Opens the boards of a device on the interfaces of a Linux machine and composes the device of
// them. Only this class knows the concrete classes of drivers and of hal/linux together. Not real
// time; the loop's thread then uses the device.
#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/composition/composed_device.h"
#include "drivers/composition/registered_can_board.h"
#include "drivers/falcon_usb/falcon.h"
#include "drivers/gpio_axis/gpio_axis.h"
#include "drivers/haply_serial/haply.h"
#include "firmware/device_file/device_config.h"
#include "firmware/linux/realtime/watchdog_output.h"
#include "hal/linux/can_bus.h"
#include "hal/linux/clock.h"
#include "hal/linux/counter.h"
#include "hal/linux/gpio_lines.h"
#include "hal/linux/pwm_output.h"
#include "hal/linux/serial_port.h"
#include "hal/linux/usb_endpoint.h"

namespace tactus::firmware {

// Why a board was not opened.
struct OpenError {
  // The connection's name in the device's file.
  std::string_view connection;
  // The text for the user: what failed and what to do.
  std::string_view what;
  // The error of the call that failed.
  hal::Error error;
};

// The boards of one device, in static storage.
class LinuxBoards {
 public:
  LinuxBoards() = default;
  LinuxBoards(const LinuxBoards&) = delete;
  LinuxBoards& operator=(const LinuxBoards&) = delete;
  ~LinuxBoards() = default;

  // Opens every connection of `config` and adds boards and joints to `device`. This object must
  // outlive the device. `falcon_firmware` holds the bytes of the Falcon's firmware, or is empty.
  // Not real time.
  std::expected<void, OpenError> open(const DeviceConfig& config,
                                      std::span<const std::byte> falcon_firmware,
                                      drivers::ComposedDevice& device);

  // Opens the GPIO line of the watchdog, if the device has one.
  std::expected<void, OpenError> open_watchdog(const DeviceConfig& config,
                                               WatchdogOutput& watchdog);

  // Returns the clock that boards and loop share.
  [[nodiscard]] hal::LinuxClock& clock() { return clock_; }

 private:
  using Outcome = std::expected<void, OpenError>;

  // A connection of the device that is to be opened.
  struct Opening {
    const DeviceConfig& device;
    std::size_t index;
    std::span<const std::byte> falcon_firmware;

    [[nodiscard]] const ConnectionConfig& connection() const { return device.connections[index]; }
    [[nodiscard]] std::span<const AxisConfig> axes() const {
      return std::span(device.axes).first(device.axis_count);
    }
    [[nodiscard]] bool has_watchdog_line() const { return device.watchdog_line.has_value(); }
  };
  // A CAN interface with the drives on it.
  struct CanLine {
    hal::LinuxCanBus bus;
    std::optional<drivers::RegisteredCanBoard> board;
  };
  // The pins, PWM channel and counter of one axis on GPIO.
  struct GpioLine {
    std::optional<hal::LinuxGpioLines> lines;
    hal::LinuxPwmOutput pwm;
    hal::LinuxCounter counter;
    std::optional<drivers::GpioAxis> axis;
  };

  // A Falcon's interface and its driver.
  struct FalconLine {
    hal::LinuxUsbEndpoint usb;
    std::optional<drivers::Falcon> falcon;
  };
  // A serial port with the Haply board behind it.
  struct HaplyLine {
    hal::LinuxSerialPort port;
    std::optional<drivers::Haply> haply;
  };

  // These open a connection of each kind.
  Outcome open(const Opening& opening, const drivers::CanConnection& can);
  Outcome open(const Opening& opening, const drivers::FalconConnection& usb);
  Outcome open(const Opening& opening, const drivers::HaplyConnection& haply);
  Outcome open(const Opening& opening, const drivers::GpioConnection& gpio);
  Outcome wire(const DeviceConfig& config, drivers::ComposedDevice& device) const;

  // Numbers the axes of a connection's board in the order in which they were added to it.
  void address_axes(const DeviceConfig& config, std::size_t connection);

  hal::LinuxClock clock_;
  std::array<CanLine, kMaxConnections> can_;
  std::array<GpioLine, kMaxConnections> gpio_;
  std::optional<hal::LinuxGpioLines> watchdog_lines_;
  std::array<FalconLine, kMaxConnections> falcons_;
  std::array<HaplyLine, kMaxConnections> haplys_;
  // The boards, one for each connection.
  std::array<drivers::BoardRef, kMaxConnections> boards_;
  // The board and the number on it of each axis.
  std::array<drivers::AxisAddress, kMaxAxes> addresses_{};
};

}  // namespace tactus::firmware
