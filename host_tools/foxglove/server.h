// A WebSocket server for clients of the Foxglove protocol: it sends, and takes nothing but
// subscriptions. One thread calls all of it; nothing here waits.
//
// There are no queues of messages. A channel has its newest message, and each subscription the
// number of the one that it has sent; a client that is slow gets the newest when it has taken the
// last, and misses those between. So it costs the others nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/foxglove/protocol.h"

namespace tactus::host {

// The server's place and limits.
struct FoxgloveServerOptions {
  // An address of this machine, IPv4.
  std::string address = "127.0.0.1";
  // The port; 0: one that is free.
  std::uint16_t port = 8765;
  // The name that clients show.
  std::string name = "tactus";
};

// One client more is refused.
inline constexpr std::size_t kMaxFoxgloveClients = 8;

class FoxgloveServer {
 public:
  // Listens. Throws InputError if the address or the port cannot be used.
  explicit FoxgloveServer(const FoxgloveServerOptions& options);
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;
  ~FoxgloveServer();

  // Returns the port on which it listens.
  [[nodiscard]] std::uint16_t port() const;

  // Sets the channels. Clients that know others are asked to connect again, which they do by
  // themselves.
  void set_channels(std::vector<FoxgloveChannel> channels);
  // Returns true if a client has subscribed to a channel, counted from 0.
  [[nodiscard]] bool is_wanted(std::size_t channel) const;
  // Makes this the newest message of a channel. Later subscribers get it, too.
  void publish(std::size_t channel, std::uint64_t time_ns, std::string payload);

  // Shows a text to the users of all clients, now and later, until another text or an empty one.
  void set_status(FoxgloveLevel level, std::string_view text);

  // Sends and receives what is ready.
  void service();
  // Returns the number of clients.
  [[nodiscard]] std::size_t clients() const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tactus::host
