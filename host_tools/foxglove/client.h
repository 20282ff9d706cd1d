// A client of the server, apart from its connection: its subscriptions, and the texts that wait for
// it. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/foxglove/protocol.h"

namespace tactus::host {

// The limits of a client. One that asks for more is refused that, or dropped.
inline constexpr std::size_t kMaxFoxgloveRequestBytes = std::size_t{64} << 10U;
inline constexpr std::size_t kMaxFoxgloveSubscriptions = 256;

// The newest message of a channel. `number` counts its messages; 0: there is none yet.
struct FoxgloveNewest {
  std::uint64_t number = 0;
  std::uint64_t time_ns = 0;
  std::string payload;
};

class FoxgloveClient {
 public:
  // Adds a text to those that wait. Returns false if there are so many that the client must be one
  // that asks and never reads.
  bool say(std::string text);
  // Takes the next text that waits; nothing if there is none.
  std::optional<std::string> take_text();

  // Takes a whole message of the client, for `channels` channels. Returns nothing, or a sentence
  // that says why the client has to go.
  std::optional<std::string> hear(std::string_view message, bool is_binary, std::size_t channels);

  // Returns a subscription whose channel has a message that it has not sent, and counts that as
  // sent; nothing if there is none. The subscriptions take turns.
  std::optional<FoxgloveSubscription> take_turn(std::span<const FoxgloveNewest> newest);
  // Returns true if a text or a message waits.
  [[nodiscard]] bool has_work(std::span<const FoxgloveNewest> newest) const;
  // Returns true if the client has subscribed to the channel, counted from 1.
  [[nodiscard]] bool wants(std::uint32_t channel) const;

  // Collects the parts of a message. Returns false if it is too long.
  bool collect(std::string_view part);
  // Takes the collected message.
  std::string take_message();

 private:
  // A subscription, and the number of its channel's message that was sent.
  struct Sent {
    FoxgloveSubscription subscription;
    std::uint64_t number = 0;
  };

  // Carry out a request. Return false if the client's texts overflow.
  bool carry_out(const FoxgloveSubscribe& request, std::size_t channels);
  bool carry_out(const FoxgloveUnsubscribe& request);
  bool carry_out(const FoxgloveNotOffered& request);
  bool subscribe(const FoxgloveSubscription& wanted, std::size_t channels);

  std::deque<std::string> texts_;
  std::vector<Sent> subscriptions_;
  // The subscription whose turn it is.
  std::size_t next_ = 0;
  std::string message_;
};

}  // namespace tactus::host
