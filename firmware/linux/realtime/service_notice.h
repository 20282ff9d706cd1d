// Sends the program's state to the service manager: systemd's datagrams to $NOTIFY_SOCKET
// (sd_notify(3)).
#pragma once

#include <optional>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

// The connection to the service manager.
class ServiceNotice {
 public:
  // Opens the socket that $NOTIFY_SOCKET names: a path, or an abstract name after an @. Without
  // the variable it succeeds, and notices are dropped. Returns 0 or errno. Not real time.
  int open();

  // Sends notices, one per line: "READY=1", "STATUS=...". Never waits; the notices are lost if the
  // socket is full. Any thread.
  void send(std::string_view notices) const;

  // Returns the period within which the manager expects "WATCHDOG=1", from $WATCHDOG_USEC. Returns
  // nothing if it expects none, or if $WATCHDOG_PID names another process.
  [[nodiscard]] static std::optional<hal::TimeNs> watchdog_period();

 private:
  hal::FileDescriptor socket_;
};

}  // namespace tactus::firmware
