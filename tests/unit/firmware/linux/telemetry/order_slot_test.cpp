#include "firmware/linux/telemetry/order_slot.h"

#include <gtest/gtest.h>

#include <string_view>
#include <thread>

namespace tactus::firmware {
namespace {

TEST(OrderSlot, GivesEveryOrderToTheOtherThreadAndItsAnswerBack) {
  constexpr int kOrders = 20;
  OrderSlot slot;
  EXPECT_EQ(slot.waiting(), nullptr);
  std::jthread carrier([&] {
    for (int done = 0; done < kOrders;) {
      if (const TelemetryOrder* const order = slot.waiting(); order != nullptr) {
        EXPECT_EQ(order->kind, TelemetryOrder::Kind::record);
        EXPECT_EQ(order->path, std::string_view("run.mcap"));
        slot.answer(100 + done);
        ++done;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (int order = 0; order < kOrders; ++order) {
    EXPECT_EQ(slot.give({.kind = TelemetryOrder::Kind::record, .path = "run.mcap"}), 100 + order);
  }
  EXPECT_EQ(slot.waiting(), nullptr);
}

}  // namespace
}  // namespace tactus::firmware
