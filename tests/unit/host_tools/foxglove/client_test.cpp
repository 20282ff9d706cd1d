// A client's subscriptions: turns, newest messages, and the limits of what it may ask.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "host_tools/foxglove/client.h"

namespace tactus::host {
namespace {

// Returns a client that has subscribed to the channels, each under a number of ten more.
FoxgloveClient subscriber(const std::vector<std::uint32_t>& channels) {
  FoxgloveClient client;
  for (const std::uint32_t channel : channels) {
    const std::string id = std::to_string(channel + 10);
    std::string text = R"({"op":"subscribe","subscriptions":[{"id":)";
    text.append(id).append(R"(,"channelId":)").append(std::to_string(channel)).append("}]}");
    EXPECT_FALSE(client.hear(text, false, 3).has_value());
  }
  return client;
}

TEST(FoxgloveClient, ASubscriptionSendsTheNewestMessageOnce) {
  FoxgloveClient client = subscriber({1});
  std::array<FoxgloveNewest, 3> newest;
  EXPECT_FALSE(client.has_work(newest));
  EXPECT_FALSE(client.take_turn(newest).has_value());
  newest[0].number = 5;  // four came before, which are gone
  ASSERT_TRUE(client.has_work(newest));
  const auto turn = client.take_turn(newest);
  ASSERT_TRUE(turn.has_value());
  EXPECT_EQ(turn->id, 11U);
  EXPECT_EQ(turn->channel, 1U);
  EXPECT_FALSE(client.has_work(newest));
  EXPECT_FALSE(client.take_turn(newest).has_value());
}

TEST(FoxgloveClient, SubscriptionsTakeTurnsWhenAllHaveMessagesAtAnyTime) {
  FoxgloveClient client = subscriber({1, 2, 3});
  std::array<FoxgloveNewest, 3> newest;
  std::map<std::uint32_t, int> sent;
  constexpr int kTurns = 30;
  for (int i = 0; i < kTurns; ++i) {
    for (FoxgloveNewest& message : newest) {
      ++message.number;
    }
    const auto turn = client.take_turn(newest);
    ASSERT_TRUE(turn.has_value());
    ++sent[turn->channel];
  }
  EXPECT_EQ(sent, (std::map<std::uint32_t, int>{{1, 10}, {2, 10}, {3, 10}}));
}

TEST(FoxgloveClient, AnUnsubscribedChannelIsNoLongerWanted) {
  FoxgloveClient client = subscriber({1, 2});
  EXPECT_TRUE(client.wants(1));
  EXPECT_FALSE(client.wants(3));
  EXPECT_FALSE(client.hear(R"({"op":"unsubscribe","subscriptionIds":[11,99]})", false, 3));
  EXPECT_FALSE(client.wants(1));
  EXPECT_TRUE(client.wants(2));
}

TEST(FoxgloveClient, AChannelThatIsNotThereIsAnsweredAndNotSubscribed) {
  FoxgloveClient client = subscriber({4, 0});
  EXPECT_FALSE(client.wants(4));
  EXPECT_FALSE(client.wants(0));
  EXPECT_NE(client.take_text().value_or("").find("there is no such channel"), std::string::npos);
  EXPECT_TRUE(client.take_text().has_value());
  EXPECT_FALSE(client.take_text().has_value());
}

TEST(FoxgloveClient, AClientThatAsksAndNeverReadsHasToGo) {
  FoxgloveClient client;
  int answered = 0;
  while (!client.hear(R"({"op":"unknown"})", false, 3).has_value()) {
    ASSERT_LT(++answered, 1000);
  }
  EXPECT_GT(answered, 10);
}

TEST(FoxgloveClient, TooManySubscriptionsAreAnsweredUntilTheClientHasToGo) {
  FoxgloveClient client;
  std::size_t asked = 0;
  const auto subscribe = [&] {
    std::string text = R"({"op":"subscribe","subscriptions":[{"id":)";
    text.append(std::to_string(asked++)).append(R"(,"channelId":1}]})");
    return client.hear(text, false, 3);
  };
  while (!subscribe().has_value()) {
    ASSERT_LT(asked, 1000U);
  }
  EXPECT_GT(asked, kMaxFoxgloveSubscriptions);
}

TEST(FoxgloveClient, PartsOfAMessageAreCollectedUpToTheLimit) {
  FoxgloveClient client;
  EXPECT_TRUE(client.collect("{\"op\":"));
  EXPECT_TRUE(client.collect("1}"));
  EXPECT_EQ(client.take_message(), "{\"op\":1}");
  EXPECT_TRUE(client.collect(std::string(kMaxFoxgloveRequestBytes, 'x')));
  EXPECT_FALSE(client.collect("x"));
}

}  // namespace
}  // namespace tactus::host
