#include "host_tools/foxglove/websocket_library.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

#include "hal/linux/system.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A client that does not answer for so long has gone, or is stuck.
constexpr lws_retry_bo_t patience() {
  lws_retry_bo_t times{};
  times.secs_since_valid_ping = 10;
  times.secs_since_valid_hangup = 30;
  return times;
}
constexpr lws_retry_bo_t kClientPatience = patience();

in_addr parsed_address(const std::string& address) {
  in_addr any{};
  if (inet_pton(AF_INET, address.c_str(), &any) != 1) {
    throw InputError(fmt::format(
        "--address {}: that is no IPv4 address; 127.0.0.1 is this machine, 0.0.0.0 all of its "
        "networks",
        address));
  }
  return any;
}

[[noreturn]] void refuse_place(const FoxgloveServerOptions& options) {
  throw InputError(
      fmt::format("{}:{} cannot be used: another program has the port, or this machine has no "
                  "such address; --port 0 finds a free one",
                  options.address, options.port));
}

// Throws InputError if the address and the port cannot be had. The library would say so too, and
// lose memory.
void check_place(const FoxgloveServerOptions& options) {
  const hal::FileDescriptor probe(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int reuse = 1;
  ::setsockopt(probe.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr = parsed_address(options.address);
  place.sin_port = htons(options.port);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the sockets' interface
  if (::bind(probe.get(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
    refuse_place(options);
  }
}

}  // namespace

WebSocketContext listen_for_clients(const FoxgloveServerOptions& options,
                                    const lws_protocols* protocols, void* user) {
  // The connections at once, among them those that are no clients yet, and the time that those
  // have.
  constexpr unsigned kMostConnections = 64;
  constexpr unsigned kHandshake_s = 5;
  // The library would report what it does on stderr.
  lws_set_log_level(0, nullptr);
  check_place(options);
  lws_context_creation_info info{};
  info.port = options.port;
  info.iface = options.address.c_str();
  info.protocols = protocols;
  info.user = user;
  info.retry_and_idle_policy = &kClientPatience;
  info.fd_limit_per_thread = kMostConnections;
  info.timeout_secs = kHandshake_s;
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_DISABLE_IPV6;
  WebSocketContext context(lws_create_context(&info));
  if (context == nullptr) {
    refuse_place(options);
  }
  return context;
}

std::uint16_t port_of(const WebSocketContext& context) {
  lws_vhost* const vhost = lws_get_vhost_by_name(context.get(), "default");
  return vhost == nullptr ? std::uint16_t{0}
                          : static_cast<std::uint16_t>(lws_get_vhost_listen_port(vhost));
}

int end_connection(lws* connection, lws_close_status status, std::string_view why) {
  constexpr std::size_t kMostBytes = 123;
  std::array<unsigned char, kMostBytes> bytes{};
  const std::size_t size = std::min(why.size(), kMostBytes);
  std::copy_n(why.begin(), size, bytes.begin());
  lws_close_reason(connection, status, bytes.data(), size);
  return -1;
}

}  // namespace tactus::host
