#include "hal/linux/counter.h"

#include <linux/counter.h>
#include <unistd.h>

#include "hal/linux/clock.h"
#include "hal/linux/counter_events.h"
#include "tests/unit/hal/counter_contract.h"
#include "tests/unit/hal/linux/sysfs_folder.h"

namespace tactus::hal {
namespace {

struct FolderCounterRig {
  FolderCounterRig() {
    folder.set("counter2/count0/count", "0");
    folder.set("counter2/count0/ceiling", std::to_string(kRigCeiling));
    folder.set("counter2/count0/function", "increase");
    folder.set("counter2/count0/enable", "0");
    EXPECT_TRUE(device.open({.counter = "counter2", .root = root, .device_root = root + "/dev"}));
  }
  Counter& counter() { return device; }
  Clock& clock() { return time; }
  // Moves the count like the hardware, which wraps at its ceiling.
  void move(std::int64_t steps) {
    const auto size = static_cast<std::int64_t>(kRigCeiling) + 1;
    at = ((at + steps) % size + size) % size;
    folder.set("counter2/count0/count", std::to_string(at));
  }

  SysfsFolder folder;
  std::string root = folder.root();
  LinuxClock time;
  LinuxCounter device;
  std::int64_t at = 0;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Sysfs, CounterContract, FolderCounterRig);

class LinuxCounterTest : public ::testing::Test {
 protected:
  ErrorCode refusal(const CounterConfig& config) {
    const auto started = rig_.device.start(config);
    EXPECT_FALSE(started);
    return started ? ErrorCode::io : started.error().code;
  }
  FolderCounterRig rig_;
};

TEST_F(LinuxCounterTest, StartingChoosesFourfoldCountingAndEnables) {
  ASSERT_TRUE(rig_.device.start({}));
  EXPECT_EQ(rig_.folder.get("counter2/count0/function"), "quadrature x4");
  EXPECT_EQ(rig_.folder.get("counter2/count0/enable"), "1");
  EXPECT_EQ(rig_.folder.get("counter2/count0/ceiling"), "999");
}

TEST_F(LinuxCounterTest, CeilingIsWrittenAndTheModeWraps) {
  rig_.folder.set("counter2/count0/count_mode", "normal");
  ASSERT_TRUE(rig_.device.start({.ceiling = 399}));
  EXPECT_EQ(rig_.folder.get("counter2/count0/ceiling"), "399");
  EXPECT_EQ(rig_.folder.get("counter2/count0/count_mode"), "modulo-n");
}

TEST_F(LinuxCounterTest, WithoutACeilingTheCallerMustKnowIt) {
  rig_.folder.remove("counter2/count0/ceiling");
  EXPECT_EQ(refusal({}), ErrorCode::not_supported);
  ASSERT_TRUE(rig_.device.start({.ceiling = 0xFFFF'FFFF}));
  EXPECT_EQ(rig_.device.ceiling(), 0xFFFF'FFFFU);
}

TEST_F(LinuxCounterTest, ACeilingOfZeroCountsNothing) {
  rig_.folder.set("counter2/count0/ceiling", "0");
  EXPECT_EQ(refusal({}), ErrorCode::not_supported);
}

TEST_F(LinuxCounterTest, ACounterWithoutAFunctionCannotDecodeQuadrature) {
  rig_.folder.remove("counter2/count0/function");
  EXPECT_EQ(refusal({}), ErrorCode::not_supported);
}

TEST_F(LinuxCounterTest, ACounterWithoutADeviceHasNoIndexEvents) {
  EXPECT_EQ(refusal({.watch_index = true}), ErrorCode::not_supported);
}

TEST_F(LinuxCounterTest, AFileThatIsNoCounterDeviceHasNoIndexEvents) {
  rig_.folder.remove("counter2");
  rig_.folder.set("counter2", "an ordinary file");
  const auto watched = watch_counter_index(rig_.root + "/counter2", 0);
  ASSERT_FALSE(watched);
  EXPECT_EQ(watched.error().code, ErrorCode::not_supported);
}

TEST_F(LinuxCounterTest, ACountBeyondTheCeilingIsAnError) {
  ASSERT_TRUE(rig_.device.start({}));
  rig_.folder.set("counter2/count0/count", "1000");
  const auto reading = rig_.device.read();
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, ErrorCode::io);
}

TEST_F(LinuxCounterTest, WhatIsNotANumberIsAnError) {
  ASSERT_TRUE(rig_.device.start({}));
  for (const char* text : {"", "-1", "12x", "forward", "99999999999999999999999"}) {
    rig_.folder.set("counter2/count0/count", text);
    EXPECT_FALSE(rig_.device.read()) << text;
  }
}

TEST_F(LinuxCounterTest, ReadsDirectionAndNoiseInTheKernelsWords) {
  rig_.folder.set("counter3/count1/count", "5");
  rig_.folder.set("counter3/count1/ceiling", "99");
  rig_.folder.set("counter3/count1/function", "quadrature x4");
  rig_.folder.set("counter3/count1/direction", "backward");
  rig_.folder.set("counter3/count1/error_noise",
                  "No excessive noise is present at the count inputs");
  LinuxCounter counter;
  ASSERT_TRUE(counter.open({.counter = "counter3", .count = 1, .root = rig_.root}));
  ASSERT_TRUE(counter.start({}));
  const auto quiet = counter.read();
  ASSERT_TRUE(quiet);
  EXPECT_EQ(quiet->direction, CountDirection::backward);
  EXPECT_FALSE(quiet->noisy);
  rig_.folder.set("counter3/count1/error_noise", "Excessive noise is present at the count inputs");
  const auto noisy = counter.read();
  ASSERT_TRUE(noisy);
  EXPECT_TRUE(noisy->noisy);
}

TEST_F(LinuxCounterTest, MissingCounterIsNotFound) {
  LinuxCounter counter;
  const auto opened = counter.open({.counter = "counter9", .root = rig_.root});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_found);
  EXPECT_EQ(counter.start({}).error().code, ErrorCode::not_found);
}

// The device's bytes through a pipe, as the kernel's header lays them out.
class CounterEvents : public ::testing::Test {
 public:
  CounterEvents(const CounterEvents&) = delete;
  CounterEvents& operator=(const CounterEvents&) = delete;

 protected:
  CounterEvents() { EXPECT_EQ(::pipe(ends_.data()), 0); }
  ~CounterEvents() override {
    ::close(ends_[0]);
    unplug();
  }
  void unplug() {
    if (ends_[1] >= 0) {
      ::close(ends_[1]);
      ends_[1] = -1;
    }
  }
  void put(std::uint8_t event, std::uint64_t value, std::uint8_t status = 0) {
    counter_event raw{};
    raw.timestamp = 1000 + value;
    raw.value = value;
    raw.watch.event = event;
    raw.status = status;
    ASSERT_EQ(::write(ends_[1], &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
  }
  Result<std::size_t> read() { return read_counter_index(ends_[0], events_, kNoWait); }

  std::array<int, 2> ends_{-1, -1};
  std::array<CounterIndexEvent, 4> events_;
};

TEST_F(CounterEvents, IndexPulsesComeInOrderAsFarAsThereIsRoom) {
  for (std::uint64_t i = 0; i < 6; ++i) {
    put(COUNTER_EVENT_INDEX, i);
  }
  ASSERT_EQ(read(), 4U);
  EXPECT_EQ(events_[3].count, 3U);
  EXPECT_EQ(events_[3].time_ns, 1003);
  ASSERT_EQ(read(), 2U);
  EXPECT_EQ(events_[1].count, 5U);
  EXPECT_EQ(read().error().code, ErrorCode::timeout);
}

TEST_F(CounterEvents, OtherEventsAndUnreadableCountsAreLeftOut) {
  put(COUNTER_EVENT_OVERFLOW, 1);
  put(COUNTER_EVENT_INDEX, 2, EIO);
  EXPECT_EQ(read().error().code, ErrorCode::timeout);
  put(COUNTER_EVENT_OVERFLOW, 3);
  put(COUNTER_EVENT_INDEX, 4);
  ASSERT_EQ(read(), 1U);
  EXPECT_EQ(events_[0].count, 4U);
}

TEST_F(CounterEvents, ClosedDeviceIsDisconnected) {
  unplug();
  EXPECT_EQ(read().error().code, ErrorCode::disconnected);
}

}  // namespace
}  // namespace tactus::hal
