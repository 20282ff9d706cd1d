// Emulated drives on a SocketCAN interface of this machine, one for each joint of a machine.
// `tactus emulate` uses it in its own process.
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

// Makes one drive with that node number on a bus that outlives it.
using MakeCanEmulator = std::function<std::unique_ptr<CanEmulator>(
    hal::CanBus& bus, std::uint32_t seed, std::uint8_t node)>;

// The drives of one device. connect() and the machine's steps use it from one thread.
class CanDrives {
 public:
  // Makes one drive with a socket of its own for each node. Throws InputError with the remedy if
  // there is no such interface, it is no CAN interface, it carries no CAN FD although `needs_fd`,
  // or a node is named twice.
  CanDrives(const std::string& interface, std::span<const unsigned> nodes, bool needs_fd,
            std::uint32_t seed, const MakeCanEmulator& make);

  // Returns the number of drives.
  [[nodiscard]] std::size_t size() const { return drives_.size(); }
  // Returns true if the interface is present but down.
  [[nodiscard]] bool link_is_down() const { return link_is_down_; }

  // Connects drive i to joint i. Throws InputError if the machine has not exactly as many joints as
  // there are drives.
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
