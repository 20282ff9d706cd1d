// The server of a build without libwebsockets: it says how to have one.
#include "host_tools/foxglove/server.h"
#include "host_tools/input_error.h"
#include "host_tools/install_command.h"

namespace tactus::host {

class FoxgloveServer::Parts {};

FoxgloveServer::FoxgloveServer(const FoxgloveServerOptions& /*options*/) {
  throw InputError("this program was built without libwebsockets; " +
                   install_command("libwebsockets-dev") + ", then configure and build it again");
}
FoxgloveServer::~FoxgloveServer() = default;

std::uint16_t FoxgloveServer::port() const {
  return 0;
}
void FoxgloveServer::set_channels(std::vector<FoxgloveChannel> /*channels*/) {}
bool FoxgloveServer::is_wanted(std::size_t /*channel*/) const {
  return false;
}
void FoxgloveServer::publish(std::size_t /*channel*/, std::uint64_t /*time_ns*/,
                             std::string /*payload*/) {}
void FoxgloveServer::set_status(FoxgloveLevel /*level*/, std::string_view /*text*/) {}
void FoxgloveServer::service() {}
std::size_t FoxgloveServer::clients() const {
  return 0;
}

}  // namespace tactus::host
