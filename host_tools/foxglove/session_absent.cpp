// The session of a build without libwebsockets: it says how to have one.
#include "host_tools/foxglove/foxglove_session.h"
#include "host_tools/input_error.h"
#include "host_tools/install_command.h"

namespace tactus::host {

void serve_foxglove(const FoxgloveOptions& /*options*/, const std::function<bool()>& /*is_over*/) {
  throw InputError("this program was built without libwebsockets; " +
                   install_command("libwebsockets-dev") + ", then configure and build it again");
}

}  // namespace tactus::host
