#include "host_tools/foxglove/server.h"

#include <fmt/format.h>
#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <map>
#include <span>
#include <utility>

#include "host_tools/foxglove/client.h"
#include "host_tools/foxglove/websocket_library.h"

namespace tactus::host {
namespace {

// The id of the text of set_status.
constexpr std::string_view kStatusId = "controller";

// Returns the text in what the library gives a callback.
std::string_view text_in(const void* in, std::size_t size) {
  return {static_cast<const char*>(in), size};
}

}  // namespace

// The server's state, which the library's callback reaches.
class FoxgloveServer::Parts {
 public:
  explicit Parts(FoxgloveServerOptions options)
      : options_(std::move(options)),
        context_(listen_for_clients(options_, protocols_.data(), this)) {}

  [[nodiscard]] std::uint16_t port() const { return port_of(context_); }

  void set_channels(std::vector<FoxgloveChannel> channels) {
    channels_ = std::move(channels);
    newest_.assign(channels_.size(), {});
    ++session_;
    for (auto& [connection, place] : clients_) {
      place.is_of_before = true;
      lws_callback_on_writable(connection);
    }
  }

  [[nodiscard]] bool is_wanted(std::size_t channel) const {
    return std::ranges::any_of(clients_, [&](const auto& one) {
      return one.second.client.wants(static_cast<std::uint32_t>(channel + 1));
    });
  }

  void publish(std::size_t channel, std::uint64_t time_ns, std::string payload) {
    FoxgloveNewest& newest = newest_[channel];
    newest = {.number = newest.number + 1, .time_ns = time_ns, .payload = std::move(payload)};
    for (const auto& [connection, place] : clients_) {
      if (place.client.wants(static_cast<std::uint32_t>(channel + 1))) {
        lws_callback_on_writable(connection);
      }
    }
  }

  void set_status(FoxgloveLevel level, std::string_view text) {
    const std::string before = std::exchange(
        status_, text.empty() ? std::string{} : foxglove_status(level, text, kStatusId));
    if (before == status_) {
      return;
    }
    for (auto& [connection, place] : clients_) {
      // A client that is too slow for texts does not get this one.
      (void)place.client.say(status_.empty() ? foxglove_remove_status(kStatusId) : status_);
      lws_callback_on_writable(connection);
    }
  }

  // The library writes one message a client in a call, which a negative time lets return at once.
  void service() {
    constexpr int kMostCalls = 64;
    has_written_ = true;
    for (int i = 0; i < kMostCalls && has_written_; ++i) {
      has_written_ = false;
      lws_service(context_.get(), -1);
    }
  }

  [[nodiscard]] std::size_t clients() const { return clients_.size(); }

 private:
  // A client and its place in the protocol.
  struct Place {
    FoxgloveClient client;
    // True if it was told other channels.
    bool is_of_before = false;
  };

  // The bytes of one call. A mesh goes out in pieces, between which the other clients have theirs.
  static constexpr std::size_t kReceivedAtOnce = std::size_t{4} << 10U;
  static constexpr std::size_t kSentAtOnce = std::size_t{512} << 10U;

  // The library's callback. No exception may go through the library.
  static int on_event(lws* connection, lws_callback_reasons reason, void* /*user*/, void* in,
                      std::size_t size) {
    auto* const parts = static_cast<Parts*>(lws_context_user(lws_get_context(connection)));
    try {
      return parts->handle(connection, reason, text_in(in, size));
    } catch (const std::exception&) {
      return -1;
    }
  }

  int handle(lws* connection, lws_callback_reasons reason, std::string_view in) {
    switch (reason) {
      case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
        return filter(connection);
      case LWS_CALLBACK_ESTABLISHED:
        return greet(connection);
      case LWS_CALLBACK_RECEIVE:
        return hear(connection, in);
      case LWS_CALLBACK_SERVER_WRITEABLE:
        return write(connection);
      case LWS_CALLBACK_CLOSED:
        clients_.erase(connection);
        return 0;
      case LWS_CALLBACK_HTTP:
        return refuse_page(connection);
      default:
        return 0;
    }
  }

  // A client that asks for no protocol would otherwise get this one.
  int filter(lws* connection) const {
    const bool asks = lws_hdr_total_length(connection, WSI_TOKEN_PROTOCOL) > 0;
    return asks && clients_.size() < kMaxFoxgloveClients ? 0 : 1;
  }

  int greet(lws* connection) {
    FoxgloveClient& client = clients_[connection].client;
    bool has_room = client.say(foxglove_server_info(options_.name, session()));
    has_room = client.say(foxglove_advertise(channels_)) && has_room;
    if (!status_.empty()) {
      has_room = client.say(status_) && has_room;
    }
    lws_callback_on_writable(connection);
    return has_room ? 0 : -1;
  }

  int hear(lws* connection, std::string_view part) {
    const auto found = clients_.find(connection);
    if (found == clients_.end()) {
      return -1;
    }
    FoxgloveClient& client = found->second.client;
    if (!client.collect(part)) {
      return end_connection(connection, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE,
                            "the message is too long");
    }
    if (lws_is_final_fragment(connection) == 0 || lws_remaining_packet_payload(connection) > 0) {
      return 0;
    }
    const bool is_binary = lws_frame_is_binary(connection) != 0;
    const auto why = client.hear(client.take_message(), is_binary, channels_.size());
    if (why) {
      return end_connection(connection, LWS_CLOSE_STATUS_POLICY_VIOLATION, *why);
    }
    lws_callback_on_writable(connection);
    return 0;
  }

  // Writes one text or message, and asks for another turn if there are more.
  int write(lws* connection) {
    const auto found = clients_.find(connection);
    if (found == clients_.end()) {
      return -1;
    }
    Place& place = found->second;
    if (place.is_of_before) {
      return end_connection(connection, kServiceRestart,
                            "the channels have changed: connect again");
    }
    bytes_.assign(LWS_PRE, 0);
    if (const auto text = place.client.take_text()) {
      bytes_.insert(bytes_.end(), text->begin(), text->end());
      return send(connection, LWS_WRITE_TEXT, place.client);
    }
    if (const auto turn = place.client.take_turn(newest_)) {
      const FoxgloveNewest& message = newest_[turn->channel - 1];
      append_foxglove_message(bytes_, turn->id, message.time_ns, message.payload);
      return send(connection, LWS_WRITE_BINARY, place.client);
    }
    return 0;
  }

  // Sends `bytes_`. The library keeps what the connection does not take at once, and asks for no
  // more until that has gone.
  int send(lws* connection, lws_write_protocol kind, const FoxgloveClient& client) {
    const std::span<unsigned char> sent = std::span(bytes_).subspan(LWS_PRE);
    has_written_ = true;
    if (lws_write(connection, sent.data(), sent.size(), kind) < 0) {
      return -1;
    }
    if (client.has_work(newest_)) {
      lws_callback_on_writable(connection);
    }
    return 0;
  }

  // A browser that opens the address gets no page.
  static int refuse_page(lws* connection) {
    lws_return_http_status(connection, HTTP_STATUS_NOT_FOUND,
                           "This is a WebSocket server for Foxglove and PlotJuggler.");
    return -1;
  }

  // The name of the present set of channels.
  [[nodiscard]] std::string session() const { return fmt::format("{}-{}", started_, session_); }

  // The WebSocket protocol's number for a server that asks its clients to connect again.
  static constexpr auto kServiceRestart = static_cast<lws_close_status>(1012);

  FoxgloveServerOptions options_;
  std::array<lws_protocols, 2> protocols_{{{.name = kFoxgloveProtocol,
                                            .callback = &Parts::on_event,
                                            .rx_buffer_size = kReceivedAtOnce,
                                            .tx_packet_size = kSentAtOnce},
                                           {}}};
  std::vector<FoxgloveChannel> channels_;
  std::vector<FoxgloveNewest> newest_;
  std::string status_;
  std::map<lws*, Place> clients_;
  // The bytes of the message that is being sent, after the room that the library needs.
  std::vector<unsigned char> bytes_;
  // True if the last call of the library has written a message.
  bool has_written_ = false;
  std::int64_t started_ = std::chrono::system_clock::now().time_since_epoch().count();
  std::uint64_t session_ = 0;
  // Its end calls on_event, which uses the members above.
  WebSocketContext context_;
};

FoxgloveServer::FoxgloveServer(const FoxgloveServerOptions& options)
    : parts_(std::make_unique<Parts>(options)) {}
FoxgloveServer::~FoxgloveServer() = default;

std::uint16_t FoxgloveServer::port() const {
  return parts_->port();
}
void FoxgloveServer::set_channels(std::vector<FoxgloveChannel> channels) {
  parts_->set_channels(std::move(channels));
}
bool FoxgloveServer::is_wanted(std::size_t channel) const {
  return parts_->is_wanted(channel);
}
void FoxgloveServer::publish(std::size_t channel, std::uint64_t time_ns, std::string payload) {
  parts_->publish(channel, time_ns, std::move(payload));
}
void FoxgloveServer::set_status(FoxgloveLevel level, std::string_view text) {
  parts_->set_status(level, text);
}
void FoxgloveServer::service() {
  parts_->service();
}
std::size_t FoxgloveServer::clients() const {
  return parts_->clients();
}

}  // namespace tactus::host
