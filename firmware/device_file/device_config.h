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

#include "drivers/any_drive.h"
#include "drivers/common/words.h"
#include "drivers/composition/homing.h"
#include "drivers/composition/transmission.h"
#include "drivers/device.h"
#include "drivers/gpio_axis/gpio_axis_config.h"
#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

using drivers::EncoderKind;
using drivers::Words;

inline constexpr std::size_t kMaxConnections = 4;
inline constexpr std::size_t kMaxAxes = drivers::kMaxJoints;
inline constexpr std::uint32_t kMaxPlantDelay = 8;

// A connection to hardware, by the name that axes use for it.
struct ConnectionConfig {
  std::string_view name;
  drivers::AnyConnection line;
};

// An axis: its connection, its drive and what its encoder knows after power-up.
struct AxisConfig {
  std::string_view name;
  std::string_view connection_name;
  std::size_t connection = 0;  // index into DeviceConfig::connections
  drivers::AnyDrive drive;
  EncoderKind encoder = EncoderKind::incremental;
  // The lower end of the turn in which an absolute encoder reads after power-up, rad at its shaft;
  // the turn ends 2 pi later. Without it the driver's registration says where the turn begins.
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

// The dynamics of the device, for its simulation. The controller ignores them. Missing values
// follow from the mechanism's weights or are those of the simulated preset (host_tools/simulation).
// Friction and encoder are those of a joint: N m and rad if it turns, N and m if it slides.
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
  std::string_view preset;      // `kind` of [mechanism], one of kPresetNames
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
