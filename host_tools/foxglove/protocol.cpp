#include "host_tools/foxglove/protocol.h"

#include <fmt/format.h>

#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace tactus::host {
namespace {

using Json = nlohmann::ordered_json;

// Returns the JSON text. Names of files may be no UTF-8, which JSON has to be.
std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Returns the number that a client sent; nothing if it is none of 32 bits without a sign.
std::optional<std::uint32_t> number_in(const Json& json) {
  if (!json.is_number_unsigned() ||
      json.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(json.get<std::uint64_t>());
}

// Returns the member of an object; nothing if the value is no object or lacks it.
const Json* member_of(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return found == json.end() ? nullptr : &*found;
}

// Returns the list of that name. Returns nothing if there is none.
const Json* list_of(const Json& json, const char* name) {
  const Json* const list = member_of(json, name);
  return list != nullptr && list->is_array() ? list : nullptr;
}

std::expected<FoxgloveRequest, std::string> parse_subscribe(const Json& json) {
  const Json* const list = list_of(json, "subscriptions");
  if (list == nullptr) {
    return std::unexpected(R"(subscribe needs a list "subscriptions")");
  }
  FoxgloveSubscribe request;
  for (const Json& one : *list) {
    const Json* const id = member_of(one, "id");
    const Json* const channel = member_of(one, "channelId");
    const auto id_number = id == nullptr ? std::nullopt : number_in(*id);
    const auto channel_number = channel == nullptr ? std::nullopt : number_in(*channel);
    if (!id_number || !channel_number) {
      return std::unexpected(R"(a subscription needs the numbers "id" and "channelId")");
    }
    request.subscriptions.push_back({.id = *id_number, .channel = *channel_number});
  }
  return request;
}

std::expected<FoxgloveRequest, std::string> parse_unsubscribe(const Json& json) {
  const Json* const list = list_of(json, "subscriptionIds");
  if (list == nullptr) {
    return std::unexpected(R"(unsubscribe needs a list "subscriptionIds")");
  }
  FoxgloveUnsubscribe request;
  for (const Json& one : *list) {
    const auto id = number_in(one);
    if (!id) {
      return std::unexpected(R"("subscriptionIds" has an entry that is no number)");
    }
    request.ids.push_back(*id);
  }
  return request;
}

// Appends a number, the lowest byte first.
template <std::unsigned_integral Number>
void append_number(std::vector<unsigned char>& bytes, Number number) {
  constexpr unsigned kByte = 8;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes.push_back(static_cast<unsigned char>(number >> (kByte * i)));
  }
}

}  // namespace

std::expected<FoxgloveRequest, std::string> parse_foxglove_request(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) {
    return std::unexpected("the text is no JSON");
  }
  const Json* const op = member_of(json, "op");
  if (op == nullptr || !op->is_string()) {
    return std::unexpected(R"(the text has no word "op")");
  }
  std::string name = op->get<std::string>();
  if (name == "subscribe") {
    return parse_subscribe(json);
  }
  if (name == "unsubscribe") {
    return parse_unsubscribe(json);
  }
  return FoxgloveNotOffered{.op = std::move(name)};
}

std::string foxglove_server_info(std::string_view name, std::string_view session) {
  return text_of_json({{"op", "serverInfo"},
                       {"name", name},
                       {"capabilities", Json::array()},
                       {"metadata", Json::object()},
                       {"sessionId", session}});
}

std::string foxglove_advertise(std::span<const FoxgloveChannel> channels) {
  Json list = Json::array();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    list.push_back({{"id", i + 1},
                    {"topic", channels[i].topic},
                    {"encoding", "json"},
                    {"schemaName", channels[i].schema_name},
                    {"schema", channels[i].schema},
                    {"schemaEncoding", "jsonschema"}});
  }
  return text_of_json({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string foxglove_status(FoxgloveLevel level, std::string_view message, std::string_view id) {
  Json json = {{"op", "status"}, {"level", static_cast<unsigned>(level)}, {"message", message}};
  if (!id.empty()) {
    json["id"] = id;
  }
  return text_of_json(json);
}

std::string foxglove_remove_status(std::string_view id) {
  return text_of_json({{"op", "removeStatus"}, {"statusIds", Json::array({id})}});
}

void append_foxglove_message(std::vector<unsigned char>& bytes, std::uint32_t subscription,
                             std::uint64_t time_ns, std::string_view payload) {
  constexpr unsigned char kMessageData = 1;
  bytes.reserve(bytes.size() + kFoxgloveHeaderBytes + payload.size());
  bytes.push_back(kMessageData);
  append_number(bytes, subscription);
  append_number(bytes, time_ns);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
}

}  // namespace tactus::host
