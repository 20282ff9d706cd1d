#include "drivers/haply_serial/answers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tactus::drivers {
namespace {

constexpr std::size_t kTwoAxes = 2;

// Puts so many bytes of that value into the room, as a serial port does.
std::optional<HaplyAnswer> receive_bytes(HaplyAnswers& answers, std::byte value,
                                         std::size_t count) {
  std::ranges::fill(answers.room().first(count), value);
  return answers.take(count);
}

TEST(HaplyAnswers, PiecesBecomeAnAnswerWithTheTimeOfItsCommand) {
  HaplyAnswers answers(kTwoAxes);
  answers.ask(10);
  answers.ask(20);
  ASSERT_EQ(answers.room().size(), haply_reply_bytes(kTwoAxes));
  EXPECT_FALSE(receive_bytes(answers, std::byte{1}, 3));
  const auto first = receive_bytes(answers, std::byte{2}, answers.room().size());
  ASSERT_TRUE(first);
  EXPECT_EQ(first->bytes.size(), haply_reply_bytes(kTwoAxes));
  EXPECT_EQ(first->bytes[2], std::byte{1});
  EXPECT_EQ(first->bytes[3], std::byte{2});
  EXPECT_EQ(first->asked_ns, 10);
  EXPECT_TRUE(answers.is_awaited());
}

TEST(HaplyAnswers, AnAnswerWithoutACommandHasNoTime) {
  HaplyAnswers answers(kTwoAxes);
  const auto answer = receive_bytes(answers, std::byte{1}, answers.room().size());
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->asked_ns);
}

TEST(HaplyAnswers, APieceIsDroppedInTheSecondReadAndCountsAsTheAnswer) {
  HaplyAnswers answers(kTwoAxes);
  answers.ask(10);
  EXPECT_FALSE(receive_bytes(answers, std::byte{1}, 3));
  EXPECT_FALSE(answers.drop_late_piece());
  EXPECT_TRUE(answers.is_awaited());
  EXPECT_TRUE(answers.drop_late_piece());
  EXPECT_FALSE(answers.is_awaited());
  EXPECT_EQ(answers.room().size(), haply_reply_bytes(kTwoAxes));
}

}  // namespace
}  // namespace tactus::drivers
