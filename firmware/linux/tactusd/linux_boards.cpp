#include "firmware/linux/tactusd/linux_boards.h"

#include <variant>

namespace tactus::firmware {

namespace {

constexpr std::uint32_t kHaplyBaud = 115'200;  // the board's USB ignores it

// A build may lack libraries.
constexpr hal::Error kLeftOut{hal::ErrorCode::not_supported, 0};
constexpr std::string_view kNoGpio =
    "this program was built without GPIO; install libgpiod 2 and build it anew";

// Returns the error of a connection.
std::unexpected<OpenError> cannot(const ConnectionConfig& connection, std::string_view what,
                                  const hal::Error& error = {hal::ErrorCode::invalid_argument, 0}) {
  return std::unexpected(OpenError{connection.name, what, error});
}

}  // namespace

std::expected<void, OpenError> LinuxBoards::open(const DeviceConfig& config,
                                                 std::span<const std::byte> falcon_firmware,
                                                 drivers::ComposedDevice& device) {
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    const Outcome outcome =
        std::visit([&](const auto& line) { return open({config, i, falcon_firmware}, line); },
                   config.connections[i].line);
    if (!outcome) {
      return outcome;
    }
    address_axes(config, i);
  }
  return wire(config, device);
}

LinuxBoards::Outcome LinuxBoards::open(const Opening& opening, const drivers::CanConnection& can) {
  const ConnectionConfig& setup = opening.connection();
  CanLine& line = can_[opening.index];
  if (const auto opened = line.bus.open(can.interface); !opened) {
    return cannot(setup, "the CAN interface cannot be opened; see ip link show type can",
                  opened.error());
  }
  line.board.emplace(line.bus, clock_);
  for (const AxisConfig& axis : opening.axes()) {
    if (axis.connection != opening.index) {
      continue;
    }
    const bool added = drivers::visit_drive(axis.drive, [&](const auto& driver, const auto& drive) {
      using Drive = typename std::remove_cvref_t<decltype(driver)>::Drive;
      if constexpr (std::is_void_v<Drive>) {
        return false;  // the reader has refused it
      } else {
        return line.board->add(Drive(drive));
      }
    });
    if (!added) {
      return cannot(setup, "too many drives on one bus");
    }
  }
  boards_[opening.index] = drivers::BoardRef(*line.board);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open(const Opening& opening,
                                       const drivers::FalconConnection& usb) {
  const ConnectionConfig& setup = opening.connection();
  if (!hal::has_libusb()) {
    return cannot(setup, "this program was built without USB; install libusb-1.0 and build it anew",
                  kLeftOut);
  }
  FalconLine& line = falcons_[opening.index];
  const auto opened = line.usb.open({.vendor = drivers::kFalconVendor,
                                     .product = drivers::kFalconProduct,
                                     .serial = usb.serial,
                                     .interface = 0,
                                     .endpoint_out = drivers::kFalconEndpointOut,
                                     .endpoint_in = drivers::kFalconEndpointIn});
  if (!opened) {
    return cannot(setup,
                  usb.serial.empty()
                      ? "the Falcon cannot be opened; plug it in, and see lsusb -d 0403:cb48"
                      : "the Falcon of that serial number cannot be opened; plug it in, and see "
                        "lsusb -v -d 0403:cb48",
                  opened.error());
  }
  drivers::FalconConfig falcon = usb.falcon;
  falcon.firmware = opening.falcon_firmware;
  falcon.unproven_watchdog = falcon.unproven_watchdog || opening.has_watchdog_line();
  line.falcon.emplace(line.usb, clock_, falcon);
  boards_[opening.index] = drivers::BoardRef(*line.falcon);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open(const Opening& opening,
                                       const drivers::HaplyConnection& haply) {
  const ConnectionConfig& setup = opening.connection();
  HaplyLine& line = haplys_[opening.index];
  if (const auto opened = line.port.open(haply.port, kHaplyBaud); !opened) {
    return cannot(setup,
                  "the serial port cannot be opened; plug the board in, and see ls /dev/tty*",
                  opened.error());
  }
  drivers::HaplyConfig board = haply.haply;
  board.unproven_watchdog = board.unproven_watchdog || opening.has_watchdog_line();
  line.haply.emplace(line.port, clock_, board);
  boards_[opening.index] = drivers::BoardRef(*line.haply);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open(const Opening& opening,
                                       const drivers::GpioConnection& gpio) {
  const ConnectionConfig& setup = opening.connection();
  if (!hal::has_libgpiod()) {
    return cannot(setup, kNoGpio, kLeftOut);
  }
  const drivers::GpioAxisConfig* drive = nullptr;
  for (const AxisConfig& axis : opening.axes()) {
    if (axis.connection == opening.index) {
      if (drive != nullptr) {
        return cannot(setup, "a gpio connection carries one axis; give each its own");
      }
      drive = std::get_if<drivers::GpioAxisConfig>(&axis.drive);
    }
  }
  if (drive == nullptr) {
    return cannot(setup, "no axis uses this connection");
  }
  GpioLine& line = gpio_[opening.index];
  const std::size_t slash = gpio.pwm_folder.rfind('/');
  const std::string_view chip = gpio.pwm_folder.substr(slash + 1);
  const auto opened = slash == std::string_view::npos
                          ? line.pwm.open(chip, gpio.pwm_channel)
                          : line.pwm.open(chip, gpio.pwm_channel, gpio.pwm_folder.substr(0, slash));
  if (!opened) {
    return cannot(setup, "the PWM channel cannot be opened; see ls /sys/class/pwm", opened.error());
  }
  line.lines.emplace(gpio.chip);
  if (gpio.counter.empty()) {
    line.axis.emplace(*drive, *line.lines, line.pwm, clock_);
  } else {
    const auto counts = line.counter.open({.counter = gpio.counter, .count = gpio.counter_channel});
    if (!counts) {
      return cannot(setup, "the counter cannot be opened; see ls /sys/bus/counter/devices",
                    counts.error());
    }
    line.axis.emplace(*drive, line.counter, *line.lines, line.pwm, clock_);
  }
  boards_[opening.index] = drivers::BoardRef(*line.axis);
  return {};
}

std::expected<void, OpenError> LinuxBoards::open_watchdog(const DeviceConfig& config,
                                                          WatchdogOutput& watchdog) {
  if (!config.watchdog_line) {
    return {};
  }
  if (!hal::has_libgpiod()) {
    return std::unexpected(OpenError{"watchdog", kNoGpio, kLeftOut});
  }
  const drivers::OutputPin& pin = *config.watchdog_line;
  watchdog_lines_.emplace(config.watchdog_chip);
  const auto held = watchdog.open(*watchdog_lines_, {.offset = pin.offset,
                                                     .direction = hal::GpioDirection::output,
                                                     .active_low = pin.active_low,
                                                     .drive = pin.drive});
  if (!held) {
    return std::unexpected(OpenError{
        "watchdog", "its GPIO line cannot be had; see gpiodetect and gpioinfo", held.error()});
  }
  return {};
}

void LinuxBoards::address_axes(const DeviceConfig& config, std::size_t connection) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < config.axis_count; ++i) {
    const AxisConfig& axis = config.axes[i];
    if (axis.connection != connection) {
      continue;
    }
    const std::size_t number =
        drivers::visit_drive(axis.drive, [next](const auto& driver, const auto& drive) {
          return driver.number_on_board == nullptr ? next : driver.number_on_board(drive);
        });
    addresses_[i] = {connection, number};
    ++next;
  }
}

LinuxBoards::Outcome LinuxBoards::wire(const DeviceConfig& config,
                                       drivers::ComposedDevice& device) const {
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    if (!device.add_board(boards_[i])) {
      return cannot(config.connections[i], "too many boards");
    }
  }
  for (const JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    const bool added = device.add_joint(
        {.name = joint.name,
         .encoder = addresses_[joint.encoder],
         .motor = addresses_[joint.motor],
         .transmission = joint.transmission,
         .reference = joint.reference,
         // The limit at the joint, as the motor's shaft feels it.
         .max_torque_Nm = joint.limits.max_effort / joint.transmission.motor_ratio});
    if (!added) {
      return cannot(config.connections[config.axes[joint.motor].connection],
                    "the board has no axis of that number");
    }
  }
  return {};
}

}  // namespace tactus::firmware
