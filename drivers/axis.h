// One axis of a motor drive or an input board, before gears and mechanism. An axis is the interface
// between a device's protocol and its joints.
//
// Angles are those of the shaft that the device senses, in rad and rad/s; the torque is at the
// shaft that it drives, in N m. drivers/composition/transmission.h converts both to the joint.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/device.h"
#include "hal/clock.h"

namespace tactus::drivers {

// A reading of one axis. The protocol makes it, once a tick.
struct AxisSample {
  double position_rad = 0.0;
  double velocity_rad_per_s = 0.0;
  double torque_Nm = 0.0;          // measured by the device; valid only if has_torque
  bool has_torque = false;         // the device reports torque or current, and has sent one
  hal::TimeNs torque_time_ns = 0;  // when that came; another value is a new measurement
  hal::TimeNs time_ns = 0;  // best estimate of when the position was true; 0: no position yet
  std::uint32_t status = kDeviceNotReady;  // DeviceStatus bits; faults are latched
  // The position at which the encoder's index pulse was last seen, rad, for a reference by index.
  // It is valid only if index_seen.
  double index_rad = 0.0;
  bool index_seen = false;
};

// The command to one axis in a tick.
struct AxisCommand {
  double torque_Nm = 0.0;
  bool enable = false;  // motor power; false makes the torque zero at the device
  // The controller sets it after a fault. The power stage then goes off, even in a device that
  // keeps it on at zero torque while `enable` is false. It is never set together with `enable`.
  bool power_off = false;
};

// A fault of an axis in words, for the log and the operator. It is latched with its status bit. The
// texts live as long as the program.
struct Trouble {
  std::string_view what;    // "drive reports that its watchdog expired"; empty: no fault
  std::string_view remedy;  // "check the cable and the host's load, then reset"
  std::uint32_t code = 0;   // the number that the device's manual gives the fault
  bool is_heat = false;     // over-temperature: kDeviceTooHot is latched as well

  explicit operator bool() const { return !what.empty(); }
};

// Returns kDeviceTooHot for a trouble that is_heat, and kDeviceOk for any other.
inline std::uint32_t heat_status(const Trouble& trouble) {
  return trouble.is_heat ? kDeviceTooHot : kDeviceOk;
}

// A board serves one or several axes over one connection: the drives on a CAN bus, a USB device, or
// an input board. No call throws, allocates or waits beyond its deadline. No two calls may run at
// the same time.
//   start        begins to bring the axes up. It may be called again after `stop`. Not real time
//   read         fills in the newest samples, one for each axis. It waits for fresh ones until the
//                deadline at most
//   write        sends a command to each axis. Errors come back with the next samples
//   clear_faults forgets latched faults and brings the axes up again
//   stop         commands zero torque and power off, for an orderly end. Not real time
//   trouble      returns the latched fault of an axis, or an empty Trouble
template <class B>
concept Board =
    requires(B board, const B& constant, std::span<AxisSample> samples,
             std::span<const AxisCommand> commands, hal::TimeNs deadline_ns, std::size_t axis) {
      { constant.axis_count() } -> std::convertible_to<std::size_t>;
      { board.start() } -> std::same_as<void>;
      { board.read(samples, deadline_ns) } -> std::same_as<void>;
      { board.write(commands) } -> std::same_as<void>;
      { board.clear_faults() } -> std::same_as<void>;
      { board.stop() } -> std::same_as<void>;
      { constant.trouble(axis) } -> std::same_as<Trouble>;
    };

}  // namespace tactus::drivers
