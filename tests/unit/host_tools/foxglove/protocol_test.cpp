// The messages of the Foxglove protocol that are sent and taken, as its specification has them.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "host_tools/foxglove/protocol.h"

namespace tactus::host {
namespace {

using nlohmann::json;

TEST(FoxgloveProtocol, AMessageIsItsHeaderWithTheLowestBytesFirstAndThePayload) {
  std::vector<unsigned char> bytes = {9};
  append_foxglove_message(bytes, 0x04030201, 0x0807060504030201, "ab");
  const std::vector<unsigned char> expected = {9, 1, 1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8, 'a', 'b'};
  EXPECT_EQ(bytes, expected);
}

TEST(FoxgloveProtocol, ChannelsAreNumberedFromOneAndSayHowToReadThem) {
  const std::array<FoxgloveChannel, 2> channels = {
      {{.topic = "/a", .schema_name = "A", .schema = R"({"type":"object"})"},
       {.topic = "/b\xff", .schema_name = "B", .schema = "{}"}}};
  const json text = json::parse(foxglove_advertise(channels));
  EXPECT_EQ(text["op"], "advertise");
  ASSERT_EQ(text["channels"].size(), 2U);
  EXPECT_EQ(text["channels"][0], json({{"id", 1},
                                       {"topic", "/a"},
                                       {"encoding", "json"},
                                       {"schemaName", "A"},
                                       {"schema", R"({"type":"object"})"},
                                       {"schemaEncoding", "jsonschema"}}));
  EXPECT_EQ(text["channels"][1]["id"], 2);
}

TEST(FoxgloveProtocol, TheServerOffersNothingButItsChannels) {
  const json text = json::parse(foxglove_server_info("tactus", "7"));
  EXPECT_EQ(text["op"], "serverInfo");
  EXPECT_EQ(text["name"], "tactus");
  EXPECT_EQ(text["capabilities"], json::array());
  EXPECT_EQ(text["sessionId"], "7");
}

TEST(FoxgloveProtocol, AStatusHasItsLevelAndCanBeRemoved) {
  EXPECT_EQ(json::parse(foxglove_status(FoxgloveLevel::error, "gone", "x")),
            json({{"op", "status"}, {"level", 2}, {"message", "gone"}, {"id", "x"}}));
  EXPECT_FALSE(json::parse(foxglove_status(FoxgloveLevel::info, "well", "")).contains("id"));
  EXPECT_EQ(json::parse(foxglove_remove_status("x")),
            json({{"op", "removeStatus"}, {"statusIds", {"x"}}}));
}

TEST(FoxgloveProtocol, SubscriptionsAreReadFromAClientsText) {
  const auto request = parse_foxglove_request(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":1}]})");
  ASSERT_TRUE(request.has_value());
  const auto* const subscribe = std::get_if<FoxgloveSubscribe>(&*request);
  ASSERT_NE(subscribe, nullptr);
  ASSERT_EQ(subscribe->subscriptions.size(), 2U);
  EXPECT_EQ(subscribe->subscriptions[0].id, 0U);
  EXPECT_EQ(subscribe->subscriptions[0].channel, 3U);
  EXPECT_EQ(subscribe->subscriptions[1].id, 4294967295U);
}

TEST(FoxgloveProtocol, TheEndOfSubscriptionsIsReadFromAClientsText) {
  const auto request = parse_foxglove_request(R"({"op":"unsubscribe","subscriptionIds":[2,0]})");
  ASSERT_TRUE(request.has_value());
  const auto* const unsubscribe = std::get_if<FoxgloveUnsubscribe>(&*request);
  ASSERT_NE(unsubscribe, nullptr);
  EXPECT_EQ(unsubscribe->ids, (std::vector<std::uint32_t>{2, 0}));
}

TEST(FoxgloveProtocol, ARequestThatIsNotOfferedHasItsName) {
  const auto request = parse_foxglove_request(R"({"op":"getParameters","parameterNames":[]})");
  ASSERT_TRUE(request.has_value());
  const auto* const other = std::get_if<FoxgloveNotOffered>(&*request);
  ASSERT_NE(other, nullptr);
  EXPECT_EQ(other->op, "getParameters");
}

TEST(FoxgloveProtocol, TextsThatAreNoRequestsAreRefusedWithASentence) {
  for (const std::string text :
       {"", "{", "null", "[]", "{}", R"({"op":1})", "\xff", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[1]})",
        R"({"op":"subscribe","subscriptions":[{"id":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"unsubscribe"})", R"({"op":"unsubscribe","subscriptionIds":[null]})"}) {
    const auto request = parse_foxglove_request(text);
    ASSERT_FALSE(request.has_value()) << text;
    EXPECT_FALSE(request.error().empty());
  }
  EXPECT_FALSE(parse_foxglove_request(std::string(60'000, '[')).has_value());
}

}  // namespace
}  // namespace tactus::host
