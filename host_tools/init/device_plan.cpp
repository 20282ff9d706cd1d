#include "host_tools/init/device_plan.h"

#include <algorithm>

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 3> kArmJoints{"azimuth", "upper arm", "forearm"};
constexpr std::array<std::string_view, 3> kDeltaJoints{"top arm", "right arm", "left arm"};
constexpr std::array<std::string_view, 2> kPantographJoints{"left arm", "right arm"};
constexpr std::array<std::string_view, 1> kPaddleJoints{"paddle"};
constexpr std::array<std::string_view, 3> kCartesianJoints{"x", "y", "z"};

constexpr std::array<PlannedLength, 3> kArmPlan{
    {{.key = "upper_m", .words = "shoulder to elbow", .usual_m = 0.2},
     {.key = "forearm_m", .words = "elbow to handle", .usual_m = 0.2},
     {.key = "shoulder_height_m", .words = "height of the shoulder", .usual_m = 0.1}}};
constexpr std::array<PlannedLength, 4> kDeltaPlan{
    {{.key = "arm_m", .words = "motor axis to elbow", .usual_m = 0.08},
     {.key = "rod_m", .words = "rods, hinge to hinge", .usual_m = 0.16},
     {.key = "base_radius_m", .words = "middle of the base to a motor axis", .usual_m = 0.06},
     {.key = "platform_radius_m", .words = "handle to a rod's hinge", .usual_m = 0.03}}};
constexpr std::array<PlannedLength, 3> kPantographPlan{
    {{.key = "base_m", .words = "between the motor axes", .usual_m = 0.03},
     {.key = "proximal_m", .words = "motor axis to elbow", .usual_m = 0.08},
     {.key = "distal_m", .words = "elbow to handle", .usual_m = 0.11}}};
constexpr std::array<PlannedLength, 1> kPaddlePlan{
    {{.key = "handle_radius_m", .words = "axis to handle", .usual_m = 0.07}}};
constexpr std::array<PlannedLength, 1> kCartesianPlan{
    {{.key = "", .words = "travel of each axis", .usual_m = 0.2}}};

constexpr std::array<PlannedMechanism, 5> kMechanisms{
    {{.name = "serial_arm",
      .kind = "phantom_premium",
      .words = "three joints: azimuth, upper arm, forearm, driven from the base",
      .joints = kArmJoints,
      .lengths = kArmPlan,
      .ratio = 10.0,
      .torque_Nm = 0.15,
      .handle_kg = 0.08},
     {.name = "delta",
      .kind = "falcon",
      .words = "three arms with rods to a platform, like the Falcon",
      .joints = kDeltaJoints,
      .lengths = kDeltaPlan,
      .ratio = 6.0,
      .torque_Nm = 0.15,
      .handle_kg = 0.12},
     {.name = "pantograph",
      .kind = "haply_pantograph",
      .words = "two motors and four links, flat, like the Haply",
      .joints = kPantographJoints,
      .lengths = kPantographPlan,
      .ratio = 4.0,
      .torque_Nm = 0.15,
      .handle_kg = 0.06},
     {.name = "paddle",
      .kind = "hapkit",
      .words = "one joint, a handle on an arc, like the Hapkit",
      .joints = kPaddleJoints,
      .lengths = kPaddlePlan,
      .ratio = 15.0,
      .torque_Nm = 0.03,
      .handle_kg = 0.08},
     {.name = "cartesian",
      .kind = "cartesian",
      .words = "three slides; a ratio is 1 / the drum's radius in m",
      .joints = kCartesianJoints,
      .lengths = kCartesianPlan,
      .ratio = 100.0,
      .torque_Nm = 0.1,
      .handle_kg = 0.15}}};

constexpr std::array<PlannedDrive, 7> kDrives{
    {{.name = "odrive_can",
      .words = "ODrive on CAN",
      .connection_words = "CAN interface",
      .connection = "can0",
      .mechanism = "",
      .emulated = "odrive"},
     {.name = "moteus_canfd",
      .words = "moteus on CAN FD",
      .connection_words = "CAN interface",
      .connection = "can0",
      .mechanism = "",
      .emulated = "moteus"},
     {.name = "cia402_can",
      .words = "CiA 402 servo drives on CANopen",
      .connection_words = "CAN interface",
      .connection = "can0",
      .mechanism = "",
      .emulated = "cia402"},
     {.name = "vesc_can",
      .words = "VESC on CAN",
      .connection_words = "CAN interface",
      .connection = "can0",
      .mechanism = "",
      .emulated = "vesc"},
     {.name = "gpio_axis",
      .words = "motor bridges and encoders on the board's own pins",
      .connection_words = "label of the GPIO chip (gpiodetect lists them)",
      .connection = "gpiochip0",
      .mechanism = "",
      .emulated = ""},
     {.name = "falcon_usb",
      .words = "the electronics of a Novint Falcon",
      .connection_words = "serial number, or - for the only one",
      .connection = "-",
      .mechanism = "delta",
      .emulated = "falcon"},
     {.name = "haply_serial",
      .words = "a Haply board of the first generation",
      .connection_words = "serial port",
      .connection = "/dev/ttyACM0",
      .mechanism = "pantograph",
      .emulated = "haply"}}};

}  // namespace

std::span<const PlannedMechanism> planned_mechanisms() {
  return kMechanisms;
}

std::span<const PlannedDrive> planned_drives() {
  return kDrives;
}

std::string DevicePlan::title() const {
  std::string title(mechanism->name);
  std::ranges::replace(title, '_', ' ');
  return title;
}

// A VESC answers in several frames: one fills two thirds of a bus of 1 Mbit/s at 1 kHz.
double usual_rate_hz(const PlannedDrive& drive, std::size_t joints) {
  constexpr double kFast_hz = 1000.0;
  constexpr double kVescs_hz = 400.0;
  return drive.name == "vesc_can" && joints > 1 ? kVescs_hz : kFast_hz;
}

}  // namespace tactus::host
