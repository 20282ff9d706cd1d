// A CAN network interface by its name: its abilities, its state, and the restart of its controller.
// One thread at a time.
#pragma once

#include <net/if.h>

#include <array>
#include <string_view>

#include "hal/error.h"

namespace tactus::hal {

// The interface of one socket. Nothing is valid before find().
class CanInterface {
 public:
  // Finds the interface and reads its abilities. `socket` is any CAN socket. Not real time.
  //   not_found         no such interface
  //   invalid_argument  it is no CAN interface, or its name is empty or too long
  //   io                anything else the system reports
  Result<void> find(int socket, std::string_view name);

  // Returns the kernel's number of the interface, to which a socket is bound.
  [[nodiscard]] int index() const { return index_; }
  // Returns true if the interface carries CAN FD frames.
  [[nodiscard]] bool fd() const { return fd_; }

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
