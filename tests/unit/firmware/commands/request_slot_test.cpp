#include "firmware/commands/request_slot.h"

#include <gtest/gtest.h>

#include <thread>

namespace tactus::firmware {
namespace {

TEST(RequestSlot, TheNewestWinsAndTheOneBeforeIsGivenBack) {
  RequestSlot slot;
  EXPECT_TRUE(slot.post({.request = Request::home, .ticket = 1}).accepted);
  const auto posted = slot.post({.request = Request::enable, .ticket = 2});
  EXPECT_TRUE(posted.accepted);
  EXPECT_EQ(posted.replaced.request, Request::home);
  EXPECT_EQ(posted.replaced.ticket, 1U);
  const TicketedRequest taken = slot.take();
  EXPECT_EQ(taken.request, Request::enable);
  EXPECT_EQ(taken.ticket, 2U);
  EXPECT_EQ(slot.take().request, Request::none);
}

TEST(RequestSlot, NothingLesserTakesThePlaceOfAnEstop) {
  RequestSlot slot;
  EXPECT_EQ(slot.post({.request = Request::enable, .ticket = 1}).replaced.request, Request::none);
  EXPECT_TRUE(slot.post({.request = Request::estop, .ticket = 2}).accepted);
  for (const Request lesser :
       {Request::none, Request::home, Request::enable, Request::disable, Request::reset}) {
    EXPECT_FALSE(slot.post({.request = lesser, .ticket = 3}).accepted);
  }
  EXPECT_EQ(slot.take().request, Request::estop);
  EXPECT_TRUE(slot.post({.request = Request::reset, .ticket = 4}).accepted);
}

TEST(RequestSlot, BetweenThreadsEveryRequestIsTakenOrGivenBackOnceAndNoEstopIsLost) {
  constexpr Ticket kPosts = 200'000;
  constexpr Ticket kEstopEvery = 7;
  RequestSlot slot;
  std::atomic<bool> posting{true};
  Ticket taken = 0;
  Ticket stops_taken = 0;
  Ticket newest = 0;
  bool in_order = true;
  const auto take = [&] {
    const TicketedRequest request = slot.take();
    if (request.request != Request::none) {
      ++taken;
      stops_taken += request.request == Request::estop ? 1U : 0U;
      in_order = in_order && request.ticket > newest;
      newest = request.ticket;
    }
  };
  std::thread loop([&] {
    while (posting.load()) {
      take();
    }
    take();
  });
  Ticket given_back = 0;
  Ticket kept_out = 0;
  Ticket stops_posted = 0;
  Ticket stops_replaced = 0;
  for (Ticket ticket = 1; ticket <= kPosts; ++ticket) {
    const bool is_stop = ticket % kEstopEvery == 0;
    const auto posted =
        slot.post({.request = is_stop ? Request::estop : Request::home, .ticket = ticket});
    stops_posted += is_stop ? 1U : 0U;
    kept_out += posted.accepted ? 0U : 1U;
    given_back += posted.replaced.request != Request::none ? 1U : 0U;
    if (posted.replaced.request == Request::estop) {
      ++stops_replaced;
      EXPECT_TRUE(is_stop);
    }
  }
  posting = false;
  loop.join();
  EXPECT_EQ(taken + given_back + kept_out, kPosts);
  EXPECT_EQ(stops_taken + stops_replaced, stops_posted);
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace tactus::firmware
