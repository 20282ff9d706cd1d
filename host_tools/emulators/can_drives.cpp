#include "host_tools/emulators/can_drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns why an interface cannot be opened, with the commands that make one.
std::string why_no_can(const std::string& interface, const hal::Error& error) {
  switch (error.code) {
    case hal::ErrorCode::not_found:
      return fmt::format(
          "no interface '{0}'; make a virtual one as root: modprobe vcan; ip link add dev {0} type "
          "vcan; ip link set {0} mtu 72; ip link set {0} up",
          interface);
    case hal::ErrorCode::invalid_argument:
      return fmt::format("'{}' is not a CAN interface; ip -br link show type can lists them",
                         interface);
    case hal::ErrorCode::not_supported:
      return "this kernel has no raw CAN; as root: modprobe can-raw";
    default:
      return fmt::format("cannot open {}: {} (errno {})", interface, hal::words(error.code),
                         error.errno_value);
  }
}

std::unique_ptr<hal::LinuxCanBus> open_can(const std::string& interface, bool needs_fd) {
  auto bus = std::make_unique<hal::LinuxCanBus>();
  if (const auto opened = bus->open(interface); !opened) {
    throw InputError(why_no_can(interface, opened.error()));
  }
  if (needs_fd && !bus->fd_enabled()) {
    throw InputError(fmt::format(
        "{0} carries no CAN FD, which this drive needs; a virtual one: ip link set {0} down; ip "
        "link set {0} mtu 72; ip link set {0} up",
        interface));
  }
  return bus;
}

}  // namespace

CanDrives::CanDrives(const std::string& interface, std::span<const unsigned> nodes, bool needs_fd,
                     std::uint32_t seed, const MakeCanEmulator& make) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (std::ranges::count(nodes, nodes[i]) > 1) {
      throw InputError(fmt::format("--nodes: {} is named twice", nodes[i]));
    }
    auto bus = open_can(interface, needs_fd);
    auto drive =
        make(*bus, seed + static_cast<std::uint32_t>(i), static_cast<std::uint8_t>(nodes[i]));
    drives_.push_back({std::move(bus), std::move(drive)});
  }
  if (!drives_.empty()) {
    link_is_down_ = drives_.front().bus->status().state == hal::CanState::stopped;
  }
}

void CanDrives::connect(EmulatedMachine& machine,
                        std::span<const drivers::Transmission> transmissions) {
  if (drives_.size() != machine.joints()) {
    throw InputError(fmt::format("--nodes names {} drives, but the mechanism has {} joints",
                                 drives_.size(), machine.joints()));
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    CanEmulator* const drive = drives_[i].drive.get();
    machine.connect({.shaft = &drive->shaft(),
                     .transmission = transmissions[i],
                     .set_fault = [drive](EmulatorFault fault) { drive->set_fault(fault); }});
    machine.add_listener([drive](hal::TimeNs now_ns) { drive->run(now_ns); },
                         drives_[i].bus->descriptor());
  }
}

}  // namespace tactus::host
