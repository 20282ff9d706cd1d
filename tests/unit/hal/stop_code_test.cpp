#include "hal/bare_metal/stop_code.h"

#include <gtest/gtest.h>

namespace tactus::hal {
namespace {

TEST(StopCode, NumbersAndNamesAreStable) {
  EXPECT_EQ(stop_name(StopCode{0}), "none");
  EXPECT_EQ(stop_name(StopCode{1}), "watchdog");
  EXPECT_EQ(stop_name(StopCode{2}), "stack_overflow");
  EXPECT_EQ(stop_name(StopCode{3}), "memory_access");
  EXPECT_EQ(stop_name(StopCode{4}), "bus");
  EXPECT_EQ(stop_name(StopCode{5}), "instruction");
  EXPECT_EQ(stop_name(StopCode{6}), "hard_fault");
  EXPECT_EQ(stop_name(StopCode{7}), "interrupt");
  EXPECT_EQ(stop_name(StopCode{8}), "broken_invariant");
  EXPECT_EQ(stop_name(StopCode{9}), "scene_image");
  EXPECT_EQ(stop_name(StopCode{10}), "device_image");
  EXPECT_EQ(stop_name(StopCode{11}), "configuration");
  EXPECT_EQ(stop_name(StopCode{12}), "scene");
  EXPECT_EQ(stop_name(StopCode{13}), "unknown");
}

TEST(StopCode, TheFirstStopStaysLatched) {
  LatchedStop stop;
  EXPECT_EQ(latched_code(stop), StopCode::none);
  latch(StopCode::bus, 0x1234, stop);
  latch(StopCode::watchdog, 0x5678, stop);
  EXPECT_EQ(latched_code(stop), StopCode::bus);
  EXPECT_EQ(stop.address, 0x1234U);
}

TEST(StopCode, MemoryAfterPowerUpIsNoLatchedStop) {
  LatchedStop stop{.code = StopCode::bus, .complement = 0xdeadbeef, .address = 7};
  EXPECT_EQ(latched_code(stop), StopCode::none);
  latch(StopCode::scene, 0, stop);
  EXPECT_EQ(latched_code(stop), StopCode::scene);
}

}  // namespace
}  // namespace tactus::hal
