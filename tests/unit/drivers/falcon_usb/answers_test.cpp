#include "drivers/falcon_usb/answers.h"

#include <gtest/gtest.h>

#include <vector>

namespace tactus::drivers {
namespace {

// A host's packet decodes as a reply too.
std::vector<FalconAnswer> take_packet(FalconAnswers& answers) {
  std::vector<FalconAnswer> taken;
  for (const std::byte byte : encode({.motor = {1, 2, 3}, .lights = {}})) {
    if (const auto answer = answers.take(byte)) {
      taken.push_back(*answer);
    }
  }
  return taken;
}

TEST(FalconAnswers, AnAnswerHasTheTimeOfItsQuestion) {
  FalconAnswers answers;
  EXPECT_FALSE(answers.has_asked());
  answers.ask(10);
  answers.ask(20);
  EXPECT_TRUE(answers.is_awaited());
  const auto first = take_packet(answers);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].asked_ns, 10);
  EXPECT_EQ(first[0].reply.counts[2], 3);
  EXPECT_EQ(take_packet(answers).at(0).asked_ns, 20);
  EXPECT_FALSE(answers.is_awaited());
}

TEST(FalconAnswers, DamagedBytesAnswerAQuestionToo) {
  FalconAnswers answers;
  answers.ask(10);
  answers.ask(20);
  for (std::size_t i = 0; i < kFalconPacketBytes; ++i) {
    EXPECT_FALSE(answers.take(std::byte{'?'}));
  }
  EXPECT_EQ(take_packet(answers).at(0).asked_ns, 20);
}

TEST(FalconAnswers, ARestartForgetsTheQuestionsAndHalfAnAnswer) {
  FalconAnswers answers;
  answers.ask(10);
  EXPECT_FALSE(answers.take(std::byte{'<'}));
  answers.restart();
  EXPECT_FALSE(answers.is_awaited());
  EXPECT_FALSE(answers.has_asked());
  answers.ask(30);
  EXPECT_EQ(take_packet(answers).at(0).asked_ns, 30);
}

}  // namespace
}  // namespace tactus::drivers
