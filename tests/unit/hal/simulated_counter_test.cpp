#include "hal/simulated/counter.h"

#include "tests/unit/hal/counter_index_contract.h"
#include "tests/unit/hal/random.h"

namespace tactus::hal {
namespace {

struct SimulatedCounterRig {
  Counter& counter() { return simulated; }
  Clock& clock() { return time; }
  void move(std::int64_t steps) { simulated.move(steps); }
  void pulse_index() { simulated.pulse_index(); }

  SimulatedClock time;
  SimulatedCounter simulated{time, kRigCeiling};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, CounterContract, SimulatedCounterRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, CounterIndexContract, SimulatedCounterRig);

TEST(SimulatedCounter, MoreThanTheHardwareCanIsRefused) {
  SimulatedClock clock;
  SimulatedCounter counter(clock, 0xFFFF);
  const auto started = counter.start({.ceiling = 0x10000});
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::not_supported);
}

TEST(SimulatedCounter, RemovedCounterIsDisconnected) {
  SimulatedClock clock;
  SimulatedCounter counter(clock);
  ASSERT_TRUE(counter.start({.watch_index = true}));
  counter.remove();
  std::array<CounterIndexEvent, 1> one;
  EXPECT_EQ(counter.read().error().code, ErrorCode::disconnected);
  EXPECT_EQ(counter.read_index(one, kForever).error().code, ErrorCode::disconnected);
  counter.plug_in();
  EXPECT_TRUE(counter.start({}));
}

TEST(SimulatedCounter, DirectionAndNoiseAreTold) {
  SimulatedClock clock;
  SimulatedCounter counter(clock);
  ASSERT_TRUE(counter.start({}));
  counter.move(-3);
  counter.set_noisy(true);
  const auto reading = counter.read();
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->direction, CountDirection::backward);
  EXPECT_TRUE(reading->noisy);
}

TEST(CountDifference, SumsUpToTheTruePositionOverManyWraps) {
  Random random(3);
  for (const std::uint64_t ceiling : {3ULL, 999ULL, 0xFFFFULL, 0xFFFF'FFFFULL}) {
    SimulatedClock clock;
    SimulatedCounter counter(clock, ceiling);
    ASSERT_TRUE(counter.start({}));
    std::int64_t truth = 0;
    std::int64_t sum = 0;
    std::uint64_t last = counter.read()->count;
    for (int i = 0; i < 20'000; ++i) {
      const auto most = static_cast<std::int64_t>(ceiling / 2);
      const std::int64_t step =
          static_cast<std::int64_t>(random.below(static_cast<std::size_t>(2 * most + 1))) - most;
      counter.move(step);
      truth += step;
      const std::uint64_t now = counter.read()->count;
      sum += count_difference(last, now, ceiling);
      last = now;
      ASSERT_EQ(sum, truth) << "ceiling " << ceiling << ", step " << i;
    }
  }
}

TEST(CountDifference, KnowsTheFullWidthOf64Bits) {
  constexpr std::uint64_t kTop = ~std::uint64_t{0};
  EXPECT_EQ(count_difference(kTop, 2, kTop), 3);
  EXPECT_EQ(count_difference(2, kTop, kTop), -3);
}

}  // namespace
}  // namespace tactus::hal
