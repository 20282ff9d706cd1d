#include "host_tools/foxglove/client.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace tactus::host {
namespace {

// A client that reads has taken the texts before it asks for so much more.
constexpr std::size_t kMaxTexts = 32;

}  // namespace

bool FoxgloveClient::say(std::string text) {
  if (texts_.size() >= kMaxTexts) {
    return false;
  }
  texts_.push_back(std::move(text));
  return true;
}

std::optional<std::string> FoxgloveClient::take_text() {
  if (texts_.empty()) {
    return std::nullopt;
  }
  std::string text = std::move(texts_.front());
  texts_.pop_front();
  return text;
}

std::optional<std::string> FoxgloveClient::hear(std::string_view message, bool is_binary,
                                                std::size_t channels) {
  const auto request = is_binary ? FoxgloveRequest(FoxgloveNotOffered{.op = "a binary message"})
                                 : parse_foxglove_request(message);
  if (!request) {
    return request.error();
  }
  bool is_well = true;
  if (const auto* wanted = std::get_if<FoxgloveSubscribe>(&*request)) {
    is_well = carry_out(*wanted, channels);
  } else if (const auto* unwanted = std::get_if<FoxgloveUnsubscribe>(&*request)) {
    is_well = carry_out(*unwanted);
  } else if (const auto* other = std::get_if<FoxgloveNotOffered>(&*request)) {
    is_well = carry_out(*other);
  }
  return is_well ? std::nullopt
                 : std::optional<std::string>("too many requests without reading the answers");
}

bool FoxgloveClient::carry_out(const FoxgloveSubscribe& request, std::size_t channels) {
  return std::ranges::all_of(request.subscriptions, [&](const FoxgloveSubscription& wanted) {
    return subscribe(wanted, channels);
  });
}

bool FoxgloveClient::subscribe(const FoxgloveSubscription& wanted, std::size_t channels) {
  const auto refuse = [&](std::string_view why) {
    return say(foxglove_status(
        FoxgloveLevel::error,
        fmt::format("subscription {} of channel {}: {}", wanted.id, wanted.channel, why), {}));
  };
  if (wanted.channel == 0 || wanted.channel > channels) {
    return refuse("there is no such channel");
  }
  if (std::ranges::any_of(subscriptions_,
                          [&](const Sent& sent) { return sent.subscription.id == wanted.id; })) {
    return refuse("the number of the subscription is taken");
  }
  if (subscriptions_.size() >= kMaxFoxgloveSubscriptions) {
    return refuse("the client has too many");
  }
  subscriptions_.push_back({.subscription = wanted});
  return true;
}

bool FoxgloveClient::carry_out(const FoxgloveUnsubscribe& request) {
  std::erase_if(subscriptions_, [&](const Sent& sent) {
    return std::ranges::find(request.ids, sent.subscription.id) != request.ids.end();
  });
  return true;
}

bool FoxgloveClient::carry_out(const FoxgloveNotOffered& request) {
  constexpr std::size_t kShown = 40;
  return say(foxglove_status(
      FoxgloveLevel::warning,
      fmt::format("{}: this server only sends; it takes no commands and no messages",
                  request.op.substr(0, kShown)),
      {}));
}

std::optional<FoxgloveSubscription> FoxgloveClient::take_turn(
    std::span<const FoxgloveNewest> newest) {
  for (std::size_t i = 0; i < subscriptions_.size(); ++i) {
    next_ = (next_ + 1) % subscriptions_.size();
    Sent& sent = subscriptions_[next_];
    const FoxgloveNewest& message = newest[sent.subscription.channel - 1];
    if (sent.number != message.number) {
      sent.number = message.number;
      return sent.subscription;
    }
  }
  return std::nullopt;
}

bool FoxgloveClient::has_work(std::span<const FoxgloveNewest> newest) const {
  return !texts_.empty() || std::ranges::any_of(subscriptions_, [&](const Sent& sent) {
    return sent.number != newest[sent.subscription.channel - 1].number;
  });
}

bool FoxgloveClient::wants(std::uint32_t channel) const {
  return std::ranges::any_of(
      subscriptions_, [&](const Sent& sent) { return sent.subscription.channel == channel; });
}

bool FoxgloveClient::collect(std::string_view part) {
  if (message_.size() + part.size() > kMaxFoxgloveRequestBytes) {
    return false;
  }
  message_ += part;
  return true;
}

std::string FoxgloveClient::take_message() {
  return std::exchange(message_, {});
}

}  // namespace tactus::host
