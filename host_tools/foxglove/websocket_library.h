// The part of libwebsockets that the server needs for its start and for the end of connections. One
// thread.
#pragma once

#include <libwebsockets.h>

#include <memory>
#include <string_view>

#include "host_tools/foxglove/server.h"

namespace tactus::host {

struct WebSocketContextDeleter {
  void operator()(lws_context* context) const { lws_context_destroy(context); }
};
// The library's state; its end ends all connections.
using WebSocketContext = std::unique_ptr<lws_context, WebSocketContextDeleter>;

// Listens. `protocols`, whose last entry is empty, and `user`, which the callbacks get, must
// outlive the context. Throws InputError if the address or the port cannot be used.
WebSocketContext listen_for_clients(const FoxgloveServerOptions& options,
                                    const lws_protocols* protocols, void* user);

// Returns the port on which a context listens.
std::uint16_t port_of(const WebSocketContext& context);

// Gives a connection's end a status and a reason, which is cut at 123 bytes. Returns what a
// callback has to return then.
int end_connection(lws* connection, lws_close_status status, std::string_view why);

}  // namespace tactus::host
