#include "firmware/bare_metal/tick_load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/support/share.h"
#include "tests/unit/hal/random.h"

namespace tactus::firmware {
namespace {

TickLoad load_of(const std::vector<std::uint32_t>& durations_ns) {
  TickLoad load;
  for (const std::uint32_t duration_ns : durations_ns) {
    load.add(duration_ns);
  }
  return load;
}

TEST(TickLoad, IsNothingWithoutATick) {
  EXPECT_EQ(TickLoad().worst_ns(), 0U);
  EXPECT_EQ(TickLoad().p999_ns(), 0U);
}

TEST(TickLoad, LeavesOneSlowTickOfAThousandOutAndNotTwo) {
  std::vector<std::uint32_t> durations_ns(999, 4200);
  durations_ns.push_back(90'000);
  EXPECT_EQ(load_of(durations_ns).p999_ns(), 5000U);
  EXPECT_EQ(load_of(durations_ns).worst_ns(), 90'000U);
  durations_ns[500] = 80'500;
  EXPECT_EQ(load_of(durations_ns).p999_ns(), 81'000U);
}

TEST(TickLoad, NeverPutsTheShareAboveTheWorstTick) {
  EXPECT_EQ(load_of({4200, 4200, 4200}).p999_ns(), 4200U);
}

TEST(TickLoad, TellsTheWorstWhereTheShareIsAboveAllClasses) {
  EXPECT_EQ(load_of({4'200, 7'000'000, 9'000'000}).p999_ns(), 9'000'000U);
}

TEST(TickLoad, AgreesWithASortedList) {
  hal::Random random(11);
  for (int run = testing::share_of(200); run > 0; --run) {
    std::vector<std::uint32_t> durations_ns(1 + random.below(5000));
    for (std::uint32_t& duration_ns : durations_ns) {
      // Few are long, as of ticks.
      duration_ns = static_cast<std::uint32_t>(random.below(random.one_in(500) ? 1'000'000 : 5000));
    }
    const TickLoad load = load_of(durations_ns);
    std::ranges::sort(durations_ns, std::greater{});
    EXPECT_EQ(load.worst_ns(), durations_ns.front());
    const std::uint32_t first_kept_ns = durations_ns[durations_ns.size() / 1000];
    const std::uint32_t class_end_ns = (first_kept_ns / TickLoad::kClass_ns + 1) * 1000;
    EXPECT_EQ(load.p999_ns(), std::min(class_end_ns, durations_ns.front()));
  }
}

TEST(UsedBytes, CountTheStackFromTheLowestWordThatLostItsPaint) {
  constexpr std::uint32_t kPaint = 0xC0FFEE42;
  std::array<std::uint32_t, 10> stack{};
  stack.fill(kPaint);
  EXPECT_EQ(used_bytes(stack, kPaint), 0U);
  stack[9] = 1;
  EXPECT_EQ(used_bytes(stack, kPaint), 4U);
  stack[3] = 0;
  EXPECT_EQ(used_bytes(stack, kPaint), 28U) << "words with the paint's value above it are in use";
  stack[0] = 0;
  EXPECT_EQ(used_bytes(stack, kPaint), 40U);
}

}  // namespace
}  // namespace tactus::firmware
