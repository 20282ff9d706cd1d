// A claim on a resource of this machine that one program at a time may use, by a common name. The
// claim is a socket in the abstract name space of Unix sockets. It vanishes when the program ends
// in any way, and it needs no folder. It is visible within one network name space, like CAN
// interfaces.
#pragma once

#include <sys/types.h>

#include <string_view>

#include "hal/linux/system.h"

namespace tactus::hal {

struct ClaimOutcome {
  bool is_held = false;  // true: this object holds it from now on
  pid_t holder = 0;      // process of the program that holds it; 0: not known
  int errno_value = 0;   // the reason if not held; EADDRINUSE: another program holds it
};

// Holds the claim until it is destroyed. Not real time.
class ExclusiveClaim {
 public:
  // Takes the claim. `name` has at most 100 characters. The socket's name is "tactus/" and `name`.
  ClaimOutcome take(std::string_view name);

 private:
  FileDescriptor socket_;
};

}  // namespace tactus::hal
