// The CAN interfaces of a machine and their settings, as `ip` prints them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host_tools/doctor/machine.h"
#include "host_tools/doctor/needs.h"

namespace tactus::host {

// The folder of network interfaces in sysfs.
inline constexpr const char* kNetworkFolder = "/sys/class/net/";

struct CanLink {
  // True for vcan, which has no bit rate.
  bool is_virtual = false;
  // False if `ip` is missing or printed nothing that is understood.
  bool told = false;
  // Bit/s; 0 if not set. The data bit rate is that of CAN FD frames.
  std::int64_t bitrate = 0;
  std::int64_t data_bitrate = 0;
  // The clock of the CAN controller, Hz; 0 if it is not told.
  std::int64_t clock_hz = 0;
  // The kernel's name of the controller, such as "mcp251xfd"; empty if it is not told.
  std::string controller;
  // The error state of the CAN controller; "ERROR-ACTIVE" is the normal one.
  std::string state;
};

// Returns the interfaces that the device needs; without a device, all that are there.
std::vector<CanNeed> can_to_look_at(Machine& machine, const Needs& needs);
// Returns true if there is such an interface and it is one of CAN.
bool is_can(Machine& machine, const std::string& interface);
// Asks `ip` about an interface.
CanLink can_link(Machine& machine, const std::string& interface);

}  // namespace tactus::host
