#include "firmware/linux/tactusd/linux_boards.h"

namespace tactus::firmware {

namespace {

constexpr std::uint32_t kHaplyBaud = 115'200;  // the board's USB ignores it

// Returns the error of a connection.
std::unexpected<OpenError> cannot(const ConnectionConfig& connection, std::string_view what,
                                  const hal::Error& error = {hal::ErrorCode::invalid_argument, 0}) {
  return std::unexpected(OpenError{connection.name, what, error});
}

// Returns the axis' number on a board that has axes by itself; 0 for other boards.
std::size_t boards_own_number(const AxisConfig& axis) {
  const auto* board = std::get_if<BoardAxis>(&axis.drive);
  return board == nullptr ? 0 : board->number;
}

}  // namespace

std::expected<void, OpenError> LinuxBoards::open(const DeviceConfig& config,
                                                 std::span<const std::byte> falcon_firmware,
                                                 drivers::ComposedDevice& device) {
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    const auto& line = config.connections[i].line;
    Outcome outcome;
    if (const auto* can = std::get_if<CanConnection>(&line)) {
      outcome = open_can(config, i, *can);
    } else if (const auto* falcon = std::get_if<FalconConnection>(&line)) {
      outcome = open_falcon(config, i, falcon->falcon, falcon_firmware);
    } else if (const auto* haply = std::get_if<HaplyConnection>(&line)) {
      outcome = open_haply(config, i, *haply);
    } else if (const auto* gpio = std::get_if<GpioConnection>(&line)) {
      outcome = open_gpio(config, i, *gpio);
    }
    if (!outcome) {
      return outcome;
    }
    address_axes(config, i);
  }
  return wire(config, device);
}

LinuxBoards::Outcome LinuxBoards::open_can(const DeviceConfig& config, std::size_t connection,
                                           const CanConnection& can) {
  const ConnectionConfig& setup = config.connections[connection];
  CanLine& line = can_[connection];
  if (const auto opened = line.bus.open(can.interface); !opened) {
    return cannot(setup, "the CAN interface cannot be opened; see ip link show type can",
                  opened.error());
  }
  line.board.emplace(line.bus, clock_);
  for (const AxisConfig& axis : std::span(config.axes).first(config.axis_count)) {
    if (axis.connection != connection) {
      continue;
    }
    bool added = false;
    if (const auto* odrive = std::get_if<drivers::ODriveConfig>(&axis.drive)) {
      added = line.board->add(drivers::ODriveCan(*odrive));
    } else if (const auto* moteus = std::get_if<drivers::MoteusConfig>(&axis.drive)) {
      added = line.board->add(drivers::MoteusCanFd(*moteus));
    } else if (const auto* cia402 = std::get_if<drivers::Cia402Config>(&axis.drive)) {
      added = line.board->add(drivers::Cia402Can(*cia402));
    } else if (const auto* vesc = std::get_if<drivers::VescConfig>(&axis.drive)) {
      added = line.board->add(drivers::VescCan(*vesc));
    }
    if (!added) {
      return cannot(setup, "too many drives on one bus");
    }
  }
  boards_[connection] = drivers::BoardRef(*line.board);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open_falcon(const DeviceConfig& config, std::size_t connection,
                                              drivers::FalconConfig falcon,
                                              std::span<const std::byte> firmware) {
  const ConnectionConfig& setup = config.connections[connection];
  if (falcon_) {
    return cannot(setup, "one Falcon is all that fits");
  }
  const auto opened = usb_.open({.vendor = drivers::kFalconVendor,
                                 .product = drivers::kFalconProduct,
                                 .serial = {},
                                 .interface = 0,
                                 .endpoint_out = drivers::kFalconEndpointOut,
                                 .endpoint_in = drivers::kFalconEndpointIn});
  if (!opened) {
    return cannot(setup, "the Falcon cannot be opened; plug it in, and see lsusb -d 0403:cb48",
                  opened.error());
  }
  falcon.firmware = firmware;
  // With a watchdog line an external circuit cuts the power, so the board's own watchdog need not
  // be proven.
  falcon.unproven_watchdog = falcon.unproven_watchdog || config.watchdog_line.has_value();
  falcon_.emplace(usb_, clock_, falcon);
  boards_[connection] = drivers::BoardRef(*falcon_);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open_haply(const DeviceConfig& config, std::size_t connection,
                                             const HaplyConnection& haply) {
  const ConnectionConfig& setup = config.connections[connection];
  if (haply_) {
    return cannot(setup, "one Haply board is all that fits");
  }
  if (const auto opened = serial_.open(haply.port, kHaplyBaud); !opened) {
    return cannot(setup,
                  "the serial port cannot be opened; plug the board in, and see ls /dev/tty*",
                  opened.error());
  }
  drivers::HaplyConfig board = haply.haply;
  board.unproven_watchdog = board.unproven_watchdog || config.watchdog_line.has_value();
  haply_.emplace(serial_, clock_, board);
  boards_[connection] = drivers::BoardRef(*haply_);
  return {};
}

LinuxBoards::Outcome LinuxBoards::open_gpio(const DeviceConfig& config, std::size_t connection,
                                            const GpioConnection& gpio) {
  const ConnectionConfig& setup = config.connections[connection];
  const drivers::GpioAxisConfig* drive = nullptr;
  for (const AxisConfig& axis : std::span(config.axes).first(config.axis_count)) {
    if (axis.connection == connection) {
      if (drive != nullptr) {
        return cannot(setup, "a gpio connection carries one axis; give each its own");
      }
      drive = std::get_if<drivers::GpioAxisConfig>(&axis.drive);
    }
  }
  if (drive == nullptr) {
    return cannot(setup, "no axis uses this connection");
  }
  GpioLine& line = gpio_[connection];
  // A path names the chip's folder and the folder that it is in; a bare name is below
  // /sys/class/pwm.
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
  boards_[connection] = drivers::BoardRef(*line.axis);
  return {};
}

std::expected<void, OpenError> LinuxBoards::open_watchdog(const DeviceConfig& config,
                                                          WatchdogOutput& watchdog) {
  if (!config.watchdog_line) {
    return {};
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
    const bool has_own_number = std::holds_alternative<BoardAxis>(axis.drive);
    addresses_[i] = {connection, has_own_number ? boards_own_number(axis) : next};
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
