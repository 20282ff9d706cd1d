#include "firmware/linux/tactusd/supervisor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "tests/unit/firmware/linux/realtime/notify_socket.h"

namespace tactus::firmware {
namespace {

TEST(Supervisor, TellsTheManagerOfTheFirstTickThenThatTicksComeThenOfTheEnd) {
  const testing::NotifySocket manager;
  setenv("WATCHDOG_USEC", "20000", 1);
  ServiceNotice notice;
  ASSERT_EQ(notice.open(), 0);
  Supervisor supervisor;
  ASSERT_EQ(supervisor.start(notice), 0);
  unsetenv("WATCHDOG_USEC");
  supervisor.note(std::array{Mode::init});
  EXPECT_EQ(manager.receive(), "READY=1\n");
  EXPECT_EQ(manager.receive(), "WATCHDOG=1\n");
  // Three periods of the watchdog without a tick: nothing is said to be alive.
  usleep(60'000);
  supervisor.stop();
  EXPECT_EQ(manager.receive(), "STOPPING=1\n");
}

TEST(Supervisor, TellsPeopleOfEveryModeInOrder) {
  const ServiceNotice nobody;
  ::testing::internal::CaptureStderr();
  {
    Supervisor supervisor;
    ASSERT_EQ(supervisor.start(nobody), 0);
    for (const Mode mode : {Mode::init, Mode::homing, Mode::homing, Mode::ready, Mode::active,
                            Mode::active, Mode::fault}) {
      supervisor.note(std::array{mode});
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "tactusd: homing\ntactusd: ready\ntactusd: active\ntactusd: fault\n");
}

TEST(Supervisor, NamesTheDeviceWhereThereAreSeveral) {
  const ServiceNotice nobody;
  ::testing::internal::CaptureStderr();
  {
    Supervisor supervisor;
    ASSERT_EQ(supervisor.start(nobody, 2), 0);
    supervisor.note(std::array{Mode::init, Mode::homing});
    supervisor.note(std::array{Mode::init, Mode::ready});
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "tactusd: device 2: homing\ntactusd: device 2: ready\n");
}

}  // namespace
}  // namespace tactus::firmware
