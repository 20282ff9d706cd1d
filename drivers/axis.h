// One axis of a motor drive or an input board, before gears and mechanism: what stands between a
// device's protocol and its joints.
//
// Angles are those of the shaft that the device senses, in rad and rad/s; the torque is at the
// shaft that it drives, in N m. drivers/transmission.h takes both to the joint.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/device.h"
#include "hal/clock.h"

namespace tactus::drivers {

struct AxisSample {
  double position_rad = 0.0;
  double velocity_rad_per_s = 0.0;
  double torque_Nm = 0.0;   // as the device measures it; only if has_torque
  bool has_torque = false;  // the device reports torque or current, and has done so
  hal::TimeNs time_ns = 0;  // when the position was true, as well as is known; 0: never
  std::uint32_t status = kDeviceNotReady;  // DeviceStatus bits, faults latched
  // Where the encoder's index pulse was last seen, for a reference by index.
  double index_rad = 0.0;
  bool index_seen = false;
};

struct AxisCommand {
  double torque_Nm = 0.0;
  bool enable = false;  // motor power; false makes the torque zero at the device
  // After a fault: the power stage goes off, also where `enable` false alone leaves it on at zero
  // torque. Never together with `enable`.
  bool power_off = false;
};

// What is wrong with an axis, latched with its status bit, for the log and the operator. The texts
// live as long as the program.
struct Trouble {
  std::string_view what;    // "drive reports that its watchdog expired"; empty: nothing
  std::string_view remedy;  // "check the cable and the host's load, then reset"
  std::uint32_t code = 0;   // the device's own number, in the words of its manual
  bool is_heat = false;     // over-temperature: kDeviceTooHot beside what it is latched with

  explicit operator bool() const { return !what.empty(); }
};

inline std::uint32_t heat_status(const Trouble& trouble) {
  return trouble.is_heat ? kDeviceTooHot : kDeviceOk;
}

// Something that serves one or several axes over one connection: the drives on a CAN bus, a USB
// device, an input board. No call throws, allocates or waits beyond its deadline.
//   start        begins to bring the axes up; may be called again after `stop`. Not real time
//   read         the newest samples, one for each axis; waits for fresh ones no longer than the
//                deadline
//   write        sends a command to each axis; what went wrong comes back with the next samples
//   clear_faults forgets latched trouble and brings the axes up again
//   stop         torque zero and power off, for an orderly end; not real time
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
