#include "drivers/cia402_can/sdo_client.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::canopen {
namespace {

constexpr hal::TimeNs kSdoTimeout_ns = 500'000'000;

class SdoClientTest : public ::testing::Test {
 protected:
  std::vector<std::string> run(hal::TimeNs now_ns) {
    CanOutbox outbox;
    client_.run(now_ns, outbox);
    std::vector<std::string> sent;
    for (const hal::CanFrame& frame : outbox.frames()) {
      sent.push_back(text_of(frame));
    }
    return sent;
  }

  SdoClient client_{3, kSdoTimeout_ns};
};

TEST_F(SdoClientTest, AsksOnceAndTakesTheAnswer) {
  client_.read({0x6076, 0});
  EXPECT_EQ(run(0), std::vector<std::string>{"603#4076600000000000"});
  EXPECT_TRUE(run(1000).empty());
  client_.take(frame_of("583#43766000E8030000"));
  EXPECT_EQ(client_.state(), SdoClient::State::done);
  EXPECT_EQ(client_.value(), 1000U);
}

TEST_F(SdoClientTest, AnswersToOtherQuestionsAreIgnored) {
  client_.read({0x6076, 0});
  client_.take(frame_of("583#43766000E8030000"));  // before it was asked
  EXPECT_EQ(client_.state(), SdoClient::State::asking);
  run(0);
  client_.take(frame_of("583#43756000E8030000"));  // another object
  client_.take(frame_of("584#43766000E8030000"));  // another drive
  client_.take(frame_of("583#6076600000000000"));  // to a write
  client_.take(frame_of("583#0076600000000000"));  // no answer that there is
  EXPECT_EQ(client_.state(), SdoClient::State::asking);
}

TEST_F(SdoClientTest, LostQuestionIsRepeatedOnceThenGivenUp) {
  client_.write({0x6060, 0}, 10, 1);
  const std::vector<std::string> question{"603#2F6060000A000000"};
  EXPECT_EQ(run(0), question);
  EXPECT_TRUE(run(kSdoTimeout_ns - 1).empty());
  EXPECT_EQ(run(kSdoTimeout_ns), question);
  EXPECT_TRUE(run(2 * kSdoTimeout_ns).empty());
  EXPECT_EQ(client_.state(), SdoClient::State::unanswered);
}

TEST_F(SdoClientTest, RefusalGivesTheAbortCode) {
  client_.write({0x6072, 0}, 5000, 2);
  run(0);
  client_.take(frame_of("583#80726000 31000906"));
  EXPECT_EQ(client_.state(), SdoClient::State::refused);
  EXPECT_EQ(client_.value(), 0x0609'0031U);
}

TEST_F(SdoClientTest, SegmentedAnswerIsAborted) {
  client_.read({0x1008, 0});
  run(0);
  client_.take(frame_of("583#4108100010000000"));
  EXPECT_EQ(client_.state(), SdoClient::State::too_long);
  EXPECT_EQ(run(1000), std::vector<std::string>{"603#8008100001000405"});
  EXPECT_TRUE(run(2000).empty());
}

}  // namespace
}  // namespace tactus::drivers::canopen
