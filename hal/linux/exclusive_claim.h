// A claim on a resource of this machine that one program at a time may use, by a common name. The
// claim is a socket in the abstract name space of Unix sockets. It vanishes when the program ends
// in any way, and it needs no folder. It is visible within one network name space, like CAN
// interfaces.
#pragma once

#include <sys/types.h>

#include <string_view>

#include "hal/linux/system.h"

namespace tactus::hal {

// The result of ExclusiveClaim::take.
struct ClaimOutcome {
  // True: the object holds the claim from now on.
  bool is_held = false;
  // The process of the program that holds the claim; 0: not known.
  pid_t holder = 0;
  // The reason if the claim is not held; EADDRINUSE: another program holds it.
  int errno_value = 0;
};

// Holds one claim until it is destroyed. Not real time; one thread at a time.
class ExclusiveClaim {
 public:
  // Takes the claim. `name` has at most 100 characters. The socket's name is "tactus/" and `name`.
  ClaimOutcome take(std::string_view name);

 private:
  FileDescriptor socket_;
};

}  // namespace tactus::hal
