// Sends the program's state to the service manager: systemd's datagrams to $NOTIFY_SOCKET.
#pragma once

#include <optional>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

class ServiceNotice {
 public:
  // Reads $NOTIFY_SOCKET, a path or, with @ in front, an abstract name. 0, also without a service
  // manager, when every notice goes nowhere; or errno. Not real time.
  int open();

  // One notice a line: "READY=1", "STATUS=...". Never waits: one that finds the socket full is
  // lost. Any thread.
  void send(std::string_view notices) const;

  // How often the manager wants to hear "WATCHDOG=1", by $WATCHDOG_USEC; nothing if it does not, or
  // if $WATCHDOG_PID means another process.
  [[nodiscard]] static std::optional<hal::TimeNs> watchdog_period();

 private:
  hal::FileDescriptor socket_;
};

}  // namespace tactus::firmware
