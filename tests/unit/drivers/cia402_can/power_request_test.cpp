#include "drivers/cia402_can/power_request.h"

#include <gtest/gtest.h>

namespace tactus::drivers::cia402 {
namespace {

constexpr hal::TimeNs kMs = 1'000'000;

TEST(PowerRequest, PowerIsGrantedOnceItIsThereTenMillisecondsAfterTheRequest) {
  PowerRequest request;
  request.open(5 * kMs);
  request.note_power(14 * kMs);
  EXPECT_FALSE(request.is_granted());
  request.note_power(15 * kMs);
  EXPECT_TRUE(request.is_granted());
}

TEST(PowerRequest, AnOpenRequestKeepsItsTime) {
  PowerRequest request;
  request.open(5 * kMs);
  request.open(100 * kMs);
  EXPECT_TRUE(request.is_older_than(0.1, 105 * kMs));
  EXPECT_FALSE(request.is_older_than(0.1, 104 * kMs));
}

TEST(PowerRequest, ClosingForgetsPowerAndSupply) {
  PowerRequest request;
  request.open(0);
  request.note_power(20 * kMs);
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
