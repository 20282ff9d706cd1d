// A CAN network interface by its name: its abilities, its state, and the restart of its controller.
#pragma once

#include <net/if.h>

#include <array>
#include <string_view>

#include "hal/error.h"

namespace tactus::hal {

class CanInterface {
 public:
  // Finds the interface. `socket` is any CAN socket.
  //   not_found, invalid_argument, io
  Result<void> find(int socket, std::string_view name);

  [[nodiscard]] int index() const { return index_; }
  [[nodiscard]] bool fd() const { return fd_; }  // true if it carries CAN FD frames

  // Returns true if the interface is up. One system call.
  //   disconnected  the interface is gone
  Result<bool> is_up(int socket) const;

  // Restarts the controller after bus-off, by a netlink message to the kernel. Not real time.
  //   not_permitted, invalid_state, not_supported, io: see CanBus::restart
  Result<void> restart() const;

 private:
  std::array<char, IFNAMSIZ> name_{};
  int index_ = 0;
  bool fd_ = false;
};

}  // namespace tactus::hal
