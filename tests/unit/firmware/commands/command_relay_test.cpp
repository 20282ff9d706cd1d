// The queue with a relay in place of the loop.
#include <gtest/gtest.h>

#include "firmware/commands/command_queue.h"

namespace tactus::firmware {
namespace {

Command look_with(Ticket ticket) {
  return {.kind = CommandKind::look, .ticket = ticket};
}

TEST(CommandRelay, TheNewestRequestIsTakenBesideTheCommandsInTheirOrder) {
  CommandQueue queue;
  EXPECT_FALSE(queue.take_command());
  EXPECT_FALSE(queue.take_request());
  queue.post(look_with(1));
  queue.post(look_with(2));
  queue.post({.kind = CommandKind::request, .ticket = 3, .request = Request::home});
  const auto replaced =
      queue.post({.kind = CommandKind::request, .ticket = 4, .request = Request::disable});
  ASSERT_TRUE(replaced);
  EXPECT_EQ(replaced->ticket, 3U);
  const auto first = queue.take_request();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, CommandKind::request);
  EXPECT_EQ(first->request, Request::disable);
  EXPECT_EQ(first->ticket, 4U);
  EXPECT_EQ(queue.take_command().value_or(Command{}).ticket, 1U);
  EXPECT_EQ(queue.take_command().value_or(Command{}).ticket, 2U);
  EXPECT_FALSE(queue.take_command());
  EXPECT_FALSE(queue.take_request());
}

TEST(CommandRelay, RoomComesBackWithTheAnswersAndNotWithTheTaking) {
  CommandQueue queue;
  for (Ticket ticket = 1; queue.has_room(); ++ticket) {
    queue.post(look_with(ticket));
  }
  const Command taken = queue.take_command().value_or(Command{});
  EXPECT_FALSE(queue.has_room());
  queue.answer({.ticket = taken.ticket, .kind = taken.kind, .tick = 12});
  const Answer answer = queue.next_answer().value_or(Answer{});
  EXPECT_EQ(answer.ticket, 1U);
  EXPECT_EQ(answer.tick, 12U);
  EXPECT_TRUE(queue.has_room());
}

TEST(CommandRelay, AStopIsAnsweredByTheTickThatTheFarEndNames) {
  CommandQueue queue;
  EXPECT_FALSE(queue.take_stop());
  const std::uint32_t stop = queue.post_stop();
  EXPECT_TRUE(queue.take_stop());
  EXPECT_FALSE(queue.take_stop());
  EXPECT_FALSE(queue.stop_taken(stop));
  const std::uint32_t later = queue.post_stop();
  queue.answer_stop({.tick = 40, .after = Mode::fault});
  ASSERT_TRUE(queue.stop_taken(stop));
  EXPECT_EQ(queue.stop_taken(stop)->tick, 40U);
  EXPECT_FALSE(queue.stop_taken(later)) << "the far end has not heard of it yet";
}

}  // namespace
}  // namespace tactus::firmware
