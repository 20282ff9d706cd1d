// Texts and bytes of the Foxglove WebSocket protocol, in the version that its clients call
// foxglove.websocket.v1. Pure functions for any thread; nothing that a client sends is trusted.
#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tactus::host {

// The name of the protocol, which a client has to ask for.
inline constexpr const char* kFoxgloveProtocol = "foxglove.websocket.v1";

// A stream of messages that clients may subscribe to. Messages are JSON.
struct FoxgloveChannel {
  std::string topic;
  std::string schema_name;
  // The JSON Schema of its messages.
  std::string schema;
};

// A client's wish for a channel. The client chooses the number of the subscription, which each
// message carries. Channels are numbered from 1 in the order in which they are advertised.
struct FoxgloveSubscription {
  std::uint32_t id = 0;
  std::uint32_t channel = 0;
};

// The requests of a client. One that this server does not offer, such as publishing, has its name
// only.
struct FoxgloveSubscribe {
  std::vector<FoxgloveSubscription> subscriptions;
};
struct FoxgloveUnsubscribe {
  std::vector<std::uint32_t> ids;
};
struct FoxgloveNotOffered {
  std::string op;
};
using FoxgloveRequest = std::variant<FoxgloveSubscribe, FoxgloveUnsubscribe, FoxgloveNotOffered>;

// The weight of a status text, as the protocol numbers it.
enum class FoxgloveLevel : std::uint8_t { info, warning, error };

// Returns the request in a client's text, or a sentence that says what is wrong with it.
std::expected<FoxgloveRequest, std::string> parse_foxglove_request(std::string_view text);

// Returns the first text to each client. A client that connects again finds out by `session`
// whether the channels may be others.
std::string foxglove_server_info(std::string_view name, std::string_view session);

// Returns the text that advertises the channels.
std::string foxglove_advertise(std::span<const FoxgloveChannel> channels);

// Returns a text that the client shows to its user. A later status with the same id replaces it;
// an empty id is none.
std::string foxglove_status(FoxgloveLevel level, std::string_view message, std::string_view id);

// Returns the text that removes the status of that id.
std::string foxglove_remove_status(std::string_view id);

// Appends a message of a subscription to `bytes`: its header of kFoxgloveHeaderBytes, then the
// payload. `time_ns` counts from 1970.
inline constexpr std::size_t kFoxgloveHeaderBytes = 13;
void append_foxglove_message(std::vector<unsigned char>& bytes, std::uint32_t subscription,
                             std::uint64_t time_ns, std::string_view payload);

}  // namespace tactus::host
