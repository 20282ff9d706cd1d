// A thing of this machine that one program at a time may use, by a name that all agree on. The
// claim is a socket in the abstract name space of Unix sockets: it vanishes with the program,
// however that ends, and asks for no folder. It is seen within one network name space, as CAN
// interfaces are.
#pragma once

#include <sys/types.h>

#include <string_view>

#include "hal/linux/system.h"

namespace tactus::hal {

struct ClaimOutcome {
  bool is_held = false;  // by this object, from now on
  pid_t holder = 0;      // of the program that holds it; 0: not known
  int errno_value = 0;   // why not; EADDRINUSE: another holds it
};

// Held until it is destroyed. Not real time.
class ExclusiveClaim {
 public:
  // `name` has at most 100 characters; all claims of it begin with "tactus/".
  ClaimOutcome take(std::string_view name);

 private:
  FileDescriptor socket_;
};

}  // namespace tactus::hal
