#include "host_tools/serial/relay.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "firmware/telemetry/telemetry_event.h"
#include "hal/linux/system.h"

namespace tactus::host {
namespace {

using firmware::Answer;
using firmware::Command;
using firmware::CommandKind;
using firmware::Outcome;
using firmware::Request;

constexpr hal::TimeNs kSecond_ns = hal::kNsPerSecond;

// A relay whose line is two lists.
class RelayTest : public ::testing::Test {
 protected:
  Command look(firmware::Ticket ticket) {
    const Command command{.kind = CommandKind::look, .ticket = ticket};
    queue_.post(command);
    return command;
  }

  firmware::CommandQueue queue_;
  std::vector<Command> sent_;
  std::size_t stops_ = 0;
  Relay relay_{queue_,
               {.stop = [this](const firmware::LineStop& /*stop*/) { ++stops_; },
                .command = [this](const Command& command) { sent_.push_back(command); }},
               2};
};

TEST_F(RelayTest, TheBoardHasNoMoreCommandsThanItTakes) {
  for (firmware::Ticket ticket = 1; ticket <= 5; ++ticket) {
    look(ticket);
  }
  relay_.send_waiting(0);
  ASSERT_EQ(sent_.size(), 2U);
  relay_.send_waiting(0);
  EXPECT_EQ(sent_.size(), 2U);
  relay_.take({.ticket = 1, .kind = CommandKind::look, .tick = 7});
  EXPECT_EQ(queue_.next_answer().value_or(Answer{}).tick, 7U);
  relay_.send_waiting(0);
  ASSERT_EQ(sent_.size(), 3U);
  EXPECT_EQ(sent_.back().ticket, 3U);
}

TEST_F(RelayTest, ARequestDoesNotWaitForCommands) {
  look(1);
  look(2);
  look(3);
  relay_.send_waiting(0);
  queue_.post({.kind = CommandKind::request, .ticket = 4, .request = Request::disable});
  relay_.send_waiting(0);
  ASSERT_EQ(sent_.size(), 3U);
  EXPECT_EQ(sent_.back().request, Request::disable);
}

TEST_F(RelayTest, AStopIsSentAgainUntilItIsAnswered) {
  const std::uint32_t stop = queue_.post_stop();
  relay_.send_waiting(0);
  relay_.send_waiting(1);
  EXPECT_EQ(stops_, 1U);
  relay_.send_waiting(kSecond_ns / 10);
  EXPECT_EQ(stops_, 2U);
  const auto event = relay_.take({.ticket = kStopTicket,
                                  .kind = CommandKind::request,
                                  .request = Request::estop,
                                  .after = firmware::Mode::fault,
                                  .tick = 30});
  ASSERT_TRUE(event);
  EXPECT_EQ(name_of(*event), "estop");
  ASSERT_TRUE(queue_.stop_taken(stop));
  EXPECT_EQ(queue_.stop_taken(stop)->tick, 30U);
  relay_.send_waiting(kSecond_ns);
  EXPECT_EQ(stops_, 2U);
}

TEST_F(RelayTest, AStopDuringAStopIsSentAfterItsAnswer) {
  queue_.post_stop();
  relay_.send_waiting(0);
  const std::uint32_t second = queue_.post_stop();
  relay_.send_waiting(1);
  relay_.take(
      {.ticket = kStopTicket, .kind = CommandKind::request, .request = Request::estop, .tick = 30});
  EXPECT_FALSE(queue_.stop_taken(second));
  relay_.send_waiting(2);
  EXPECT_EQ(stops_, 2U);
}

TEST_F(RelayTest, ACommandThatTheLineLosesLeavesItsRoom) {
  look(1);
  relay_.send_waiting(0);
  relay_.send_waiting(2 * kSecond_ns);
  const Answer answer = queue_.next_answer().value_or(Answer{});
  EXPECT_EQ(answer.ticket, 1U);
  EXPECT_NE(answer.outcome, Outcome::done);
  EXPECT_FALSE(relay_.take({.ticket = 1, .kind = CommandKind::look}))
      << "an answer that comes too late is dropped";
  EXPECT_FALSE(queue_.next_answer());
}

TEST_F(RelayTest, AnswersThatNobodyWaitsForAreDropped) {
  look(1);
  relay_.send_waiting(0);
  relay_.take({.ticket = 2, .kind = CommandKind::look});
  relay_.take({.ticket = 1, .kind = CommandKind::set});
  relay_.take({.ticket = kStopTicket, .kind = CommandKind::request, .request = Request::estop});
  EXPECT_FALSE(queue_.next_answer());
}

TEST_F(RelayTest, OnlyAChangeThatWasMadeIsAnEvent) {
  const firmware::ParameterPlace force{.parameter = firmware::Parameter::max_force};
  for (const firmware::Ticket ticket : {1U, 2U}) {
    queue_.post(
        {.kind = CommandKind::set, .ticket = ticket, .change = {.place = force, .value = 3.0}});
  }
  relay_.send_waiting(0);
  EXPECT_FALSE(relay_.take(
      {.ticket = 1, .kind = CommandKind::set, .outcome = Outcome::parameter, .tick = 4}));
  const auto event = relay_.take({.ticket = 2, .kind = CommandKind::set, .tick = 5});
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, firmware::EventKind::parameter);
  EXPECT_EQ(name_of(*event), "max_force_N");
  EXPECT_EQ(event->value, 3.0);
  EXPECT_EQ(event->tick, 5U);
}

}  // namespace
}  // namespace tactus::host
