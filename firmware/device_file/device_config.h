// The configuration of one device: its connections, the axis of each joint, the mechanism and the
// limits. It has the content of device.toml, in the units of the drivers and the controller.
//
// The texts are views into the image, which must outlive it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "drivers/cia402_can/cia402_config.h"
#include "drivers/device.h"
#include "drivers/falcon_usb/falcon.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "drivers/haply_serial/haply.h"
#include "drivers/homing.h"
#include "drivers/moteus_canfd/moteus_config.h"
#include "drivers/odrive_can/odrive_config.h"
#include "drivers/transmission.h"
#include "drivers/vesc_can/vesc_config.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/device_file/words.h"

namespace tactus::firmware {

inline constexpr std::size_t kMaxConnections = 4;
inline constexpr std::size_t kMaxAxes = drivers::kMaxJoints;
inline constexpr std::uint32_t kMaxPlantDelay = 8;

// A CAN interface of the system.
struct CanConnection {
  std::string_view interface;  // "can0"
  double bit_rate = 1e6;       // bit/s, 10'000 to 1'000'000
  double data_bit_rate = 5e6;  // of CAN FD payloads, bit/s, bit_rate to 8'000'000
};
// A Falcon on USB.
struct FalconConnection {
  std::string_view firmware_file;  // uploaded when the device has none; empty: none
  drivers::FalconConfig falcon;
};
// A Haply board on a serial port.
struct HaplyConnection {
  std::string_view port;  // "/dev/ttyACM0"
  drivers::HaplyConfig haply;
};
// The pins, the PWM channel and the counter of one axis on a board.
struct GpioConnection {
  std::string_view chip;        // the GPIO chip's label, or its path
  std::string_view pwm_folder;  // "/sys/class/pwm/pwmchip0"
  std::uint32_t pwm_channel = 0;
  // The name of a hardware counter that replaces encoder edges, in /sys/bus/counter/devices; empty
  // without one.
  std::string_view counter;  // "counter0"
  std::uint32_t counter_channel = 0;
};

// A connection to hardware, by the name that axes use for it.
struct ConnectionConfig {
  std::string_view name;
  std::variant<CanConnection, FalconConnection, HaplyConnection, GpioConnection> line;
};

// An axis that the board has by itself, with its number there.
struct BoardAxis {
  std::uint8_t number = 0;
};

// The extent to which an axis' encoder knows its position after power-up.
enum class EncoderKind : std::uint8_t {
  incremental,    // not at all: it counts from where it was
  absolute_turn,  // within one turn of its shaft
  absolute,       // over all turns; a moteus: within one turn of the output's own encoder
};

// An axis: its connection, its drive and what its encoder knows after power-up.
struct AxisConfig {
  std::string_view name;
  std::string_view connection_name;
  std::size_t connection = 0;  // index into DeviceConfig::connections
  std::variant<BoardAxis, drivers::ODriveConfig, drivers::MoteusConfig, drivers::Cia402Config,
               drivers::VescConfig, drivers::GpioAxisConfig>
      drive;
  EncoderKind encoder = EncoderKind::incremental;
  // The lower end of the turn in which an absolute encoder reads after power-up, rad at its shaft;
  // the turn ends 2 pi later. Without it the turn begins at 0, or at -pi for a moteus.
  std::optional<double> encoder_turn_begins_rad;
};

// One joint: its axes, the conversion to them, its reference and its limits.
struct JointConfig {
  std::string_view name;
  std::string_view motor_name;
  std::string_view encoder_name;
  std::size_t motor = 0;  // indices into DeviceConfig::axes
  std::size_t encoder = 0;
  drivers::Transmission transmission;
  drivers::Reference reference;
  bool has_reference = false;  // the file has one
  JointLimits limits;
};

// The dynamics of the device, for `tactus certify`. The controller ignores them. Missing values are
// those of the simulated preset (host_tools/simulation). Friction and encoder are those of a joint:
// N m and rad if it turns, N and m if it slides.
struct PlantConfig {
  std::optional<double> moving_mass_kg;    // the device's mass at the handle, as the hand feels it
  std::optional<double> viscous_Ns_per_m;  // at the handle, as the hand feels it
  std::optional<double> coulomb_friction;  // while sliding
  std::optional<double> breakaway_friction;  // at least coulomb_friction
  std::optional<double> encoder_resolution;  // one count
  std::optional<double> velocity_cutoff_hz;  // of the reported velocity
  std::optional<double> motor_time_constant_s;
  std::optional<std::uint32_t> delay_ticks;  // from a command to the motors, whole ticks
};

// The certificate in the image.
struct Certification {
  bool is_there = false;
  bool is_for_these_settings = false;  // false: something has been changed since
  StiffnessCertificate limits;         // empty if it is not for these settings
  std::string_view measured_with;
};

// The commissioning result in the image.
struct Commissioning {
  bool is_there = false;
  bool is_for_these_settings = false;  // false: something has been changed since
  bool passed = false;                 // every joint answered its motor as it should
  double moving_mass_kg = 0.0;         // at the handle; it fits the joints' answers
  std::string_view measured_with;
};

// The whole device. The first connection_count, axis_count and joint_count entries of the arrays
// are in use.
struct DeviceConfig {
  std::string_view name;
  ControllerConfig controller;  // its joints' limits are those of `joints`
  PlantConfig plant;
  Certification certification;  // its limits are also the controller's
  Commissioning commissioning;
  double read_limit_s = 0.0005;  // a tick waits for fresh samples for so long at most
  // A line that every healthy tick toggles. A circuit takes the motors' power away when it stops.
  // It is on a GPIO chip, which is given by label or path.
  std::string_view watchdog_chip;
  std::optional<drivers::OutputPin> watchdog_line;
  std::array<ConnectionConfig, kMaxConnections> connections{};
  std::array<AxisConfig, kMaxAxes> axes{};
  std::array<JointConfig, kJointCount> joints{};
  std::size_t connection_count = 0;
  std::size_t axis_count = 0;
  std::size_t joint_count = 0;
  Words refusal;  // the reason why read_device refused it
};

}  // namespace tactus::firmware
