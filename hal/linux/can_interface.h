// A CAN network interface by its name: what it can do, whether it is up, and bringing its
// controller back on the bus.
#pragma once

#include <net/if.h>

#include <array>
#include <string_view>

#include "hal/error.h"

namespace tactus::hal {

class CanInterface {
 public:
  // `socket` is any CAN socket.
  //   not_found, invalid_argument, io
  Result<void> find(int socket, std::string_view name);

  [[nodiscard]] int index() const { return index_; }
  [[nodiscard]] bool fd() const { return fd_; }  // its frames may be CAN FD

  // Asks the system.
  //   disconnected  the interface is gone
  Result<bool> is_up(int socket) const;

  // Asks the kernel, by netlink, to start the controller again after bus-off. Not real time.
  //   not_permitted, invalid_state, not_supported, io: see CanBus::restart
  Result<void> restart() const;

 private:
  std::array<char, IFNAMSIZ> name_{};
  int index_ = 0;
  bool fd_ = false;
};

}  // namespace tactus::hal
