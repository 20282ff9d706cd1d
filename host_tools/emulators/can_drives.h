// Emulated drives on a SocketCAN interface of this machine, as a device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/composition/transmission.h"
#include "hal/linux/can_bus.h"
#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/emulated_machine.h"

namespace tactus::host {

// Makes one drive on a bus that outlives it.
using MakeCanEmulator = std::function<std::unique_ptr<CanEmulator>(
    hal::CanBus& bus, std::uint32_t seed, std::uint8_t node)>;

class CanDrives {
 public:
  // One drive and one socket for each node. Throws InputError, text for a user: no such interface,
  // no CAN here, an interface without CAN FD where it is needed, a node named twice.
  CanDrives(const std::string& interface, std::span<const unsigned> nodes, bool needs_fd,
            std::uint32_t seed, const MakeCanEmulator& make);

  [[nodiscard]] std::size_t size() const { return drives_.size(); }
  // The interface is there, but down.
  [[nodiscard]] bool link_is_down() const { return link_is_down_; }

  // Drive i to joint i. Throws InputError if the machine has not as many joints as there are
  // drives.
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  struct Node {
    std::unique_ptr<hal::LinuxCanBus> bus;
    std::unique_ptr<CanEmulator> drive;
  };
  std::vector<Node> drives_;
  bool link_is_down_ = false;
};

}  // namespace tactus::host
