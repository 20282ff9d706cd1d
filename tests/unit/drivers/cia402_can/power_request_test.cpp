#include "drivers/cia402_can/power_request.h"

#include <gtest/gtest.h>

namespace tactus::drivers::cia402 {
namespace {

constexpr hal::TimeNs kRequest_ms = 1'000'000;

TEST(PowerRequest, PowerIsGrantedOnceItIsThereTenMillisecondsAfterTheRequest) {
  PowerRequest request;
  request.open(5 * kRequest_ms);
  request.note_power(14 * kRequest_ms);
  EXPECT_FALSE(request.is_granted());
  request.note_power(15 * kRequest_ms);
  EXPECT_TRUE(request.is_granted());
}

TEST(PowerRequest, AnOpenRequestKeepsItsTime) {
  PowerRequest request;
  request.open(5 * kRequest_ms);
  request.open(100 * kRequest_ms);
  EXPECT_TRUE(request.is_older_than(0.1, 105 * kRequest_ms));
  EXPECT_FALSE(request.is_older_than(0.1, 104 * kRequest_ms));
}

TEST(PowerRequest, ClosingForgetsPowerAndSupply) {
  PowerRequest request;
  request.open(0);
  request.note_power(20 * kRequest_ms);
  request.note_supply();
  EXPECT_TRUE(request.is_granted());
  EXPECT_TRUE(request.had_supply());
  request.close();
  EXPECT_FALSE(request.is_granted());
  EXPECT_FALSE(request.had_supply());
}

TEST(PowerRequest, ASupplyWithoutARequestDoesNotCount) {
  PowerRequest request;
  request.note_supply();
  EXPECT_FALSE(request.had_supply());
}

}  // namespace
}  // namespace tactus::drivers::cia402
