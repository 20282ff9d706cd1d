#include "firmware/telemetry/stopwatch.h"

#include <gtest/gtest.h>

namespace tactus::firmware {
namespace {

std::uint64_t g_now_ns = 0;
std::uint64_t fake_now_ns() {
  return g_now_ns;
}

TEST(Stopwatch, GivesTheTimeSinceTheLapBefore) {
  g_now_ns = 1000;
  Stopwatch watch(fake_now_ns);
  g_now_ns = 1250;
  EXPECT_EQ(watch.lap_ns(), 250U);
  g_now_ns = 1300;
  EXPECT_EQ(watch.lap_ns(), 50U);
}

TEST(Stopwatch, SaturatesInsteadOfWrapping) {
  g_now_ns = 0;
  Stopwatch watch(fake_now_ns);
  g_now_ns = 1ULL << 40;
  EXPECT_EQ(watch.lap_ns(), 0xFFFF'FFFFU);
}

TEST(Stopwatch, IsZeroWithoutAClock) {
  Stopwatch watch(nullptr);
  EXPECT_EQ(watch.lap_ns(), 0U);
}

}  // namespace
}  // namespace tactus::firmware
