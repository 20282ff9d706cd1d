#include <vector>

#include "hal/simulated/clock.h"
#include "tests/unit/hal/clock_contract.h"

namespace tactus::hal {
namespace {

struct SimulatedClockRig {
  Clock& clock() { return simulated; }
  SimulatedClock simulated;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, ClockContract, SimulatedClockRig);

struct Happening {
  int who;
  TimeNs when_ns;
  friend bool operator==(const Happening&, const Happening&) = default;
};

class Repeater final : public SimulatedEventSource {
 public:
  Repeater(SimulatedClock& clock, int who, TimeNs first_ns, TimeNs period_ns,
           std::vector<Happening>& log)
      : clock_(clock), who_(who), next_ns_(first_ns), period_ns_(period_ns), log_(log) {
    clock_.attach(*this);
  }
  Repeater(const Repeater&) = delete;
  Repeater& operator=(const Repeater&) = delete;
  ~Repeater() { clock_.detach(*this); }

  TimeNs next_event_ns() const override { return next_ns_; }
  void run_event() override {
    log_.push_back({who_, clock_.now_ns()});
    next_ns_ += period_ns_;
    nested_wait_ended_at_ns_ = clock_.sleep_until(clock_.now_ns() + 1000).woke_ns;
  }
  TimeNs nested_wait_ended_at_ns() const { return nested_wait_ended_at_ns_; }

 private:
  SimulatedClock& clock_;
  int who_;
  TimeNs next_ns_;
  TimeNs period_ns_;
  std::vector<Happening>& log_;
  TimeNs nested_wait_ended_at_ns_ = 0;
};

TEST(SimulatedClock, StandsStillUntilTold) {
  SimulatedClock clock(500);
  EXPECT_EQ(clock.now_ns(), 500);
  EXPECT_EQ(clock.now_ns(), 500);
  clock.advance_by(7);
  EXPECT_EQ(clock.now_ns(), 507);
  clock.advance_to(100);
  EXPECT_EQ(clock.now_ns(), 507);
}

TEST(SimulatedClock, SleeperWakesOnTheNanosecond) {
  SimulatedClock clock(0);
  EXPECT_EQ(clock.sleep_until(12'345).woke_ns, 12'345);
}

TEST(SimulatedClock, EventsHappenInOrderOfTimeThenOfAttachment) {
  SimulatedClock clock(0);
  std::vector<Happening> log;
  Repeater slow(clock, 1, 20, 20, log);
  Repeater fast(clock, 2, 10, 10, log);
  clock.advance_to(40);
  EXPECT_EQ(log, (std::vector<Happening>{{2, 10}, {1, 20}, {2, 20}, {2, 30}, {1, 40}, {2, 40}}));
}

TEST(SimulatedClock, DetachedSourceIsSilent) {
  SimulatedClock clock(0);
  std::vector<Happening> log;
  Repeater stays(clock, 1, 10, 10, log);
  {
    Repeater leaves(clock, 2, 10, 10, log);
    clock.advance_to(10);
  }
  clock.advance_to(20);
  EXPECT_EQ(log, (std::vector<Happening>{{1, 10}, {2, 10}, {1, 20}}));
}

TEST(SimulatedClock, WaitEndsWhenTheEventMakesItReady) {
  SimulatedClock clock(0);
  std::vector<Happening> log;
  Repeater source(clock, 1, 30, 30, log);
  EXPECT_TRUE(clock.wait_until(1000, [&] { return log.size() == 2; }));
  EXPECT_EQ(clock.now_ns(), 60);
  EXPECT_FALSE(clock.wait_until(70, [&] { return log.size() == 3; }));
  EXPECT_EQ(clock.now_ns(), 70);
}

TEST(SimulatedClock, EndlessWaitThatNothingCanEndIsOverAtOnce) {
  SimulatedClock clock(5);
  EXPECT_FALSE(clock.wait_until(kForever, [] { return false; }));
  EXPECT_EQ(clock.now_ns(), 5);
}

TEST(SimulatedClock, TimeStandsStillInsideAnEvent) {
  SimulatedClock clock(0);
  std::vector<Happening> log;
  Repeater source(clock, 1, 10, 10, log);
  clock.advance_to(10);
  EXPECT_EQ(source.nested_wait_ended_at_ns(), 10);
}

}  // namespace
}  // namespace tactus::hal
