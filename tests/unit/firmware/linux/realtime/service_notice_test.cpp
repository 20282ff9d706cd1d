#include "firmware/linux/realtime/service_notice.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "tests/unit/firmware/linux/realtime/notify_socket.h"

namespace tactus::firmware {
namespace {

TEST(ServiceNotice, ReachesTheManagerAsADatagram) {
  const testing::NotifySocket manager;
  ServiceNotice notice;
  ASSERT_EQ(notice.open(), 0);
  notice.send("READY=1\n");
  notice.send("WATCHDOG=1\n");
  EXPECT_EQ(manager.receive(), "READY=1\n");
  EXPECT_EQ(manager.receive(), "WATCHDOG=1\n");
}

TEST(ServiceNotice, GoesNowhereWithoutAManager) {
  ServiceNotice notice;
  EXPECT_EQ(notice.open(), 0);
  notice.send("READY=1\n");
}

TEST(ServiceNotice, RefusesANameThatIsNoSocket) {
  ServiceNotice notice;
  for (const std::string& name : {std::string("relative"), "/" + std::string(200, 'x')}) {
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    EXPECT_EQ(notice.open(), EINVAL) << name;
  }
  setenv("NOTIFY_SOCKET", "/nowhere/at/all", 1);
  EXPECT_EQ(notice.open(), ENOENT);
  unsetenv("NOTIFY_SOCKET");
}

TEST(ServiceNotice, TakesTheWatchdogsPeriodOnlyIfItIsMeantForThisProcess) {
  unsetenv("WATCHDOG_PID");
  unsetenv("WATCHDOG_USEC");
  EXPECT_FALSE(ServiceNotice::watchdog_period());
  setenv("WATCHDOG_USEC", "2000000", 1);
  EXPECT_EQ(ServiceNotice::watchdog_period(), 2'000'000'000);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(ServiceNotice::watchdog_period(), 2'000'000'000);
  setenv("WATCHDOG_PID", "1", 1);
  EXPECT_FALSE(ServiceNotice::watchdog_period());
  unsetenv("WATCHDOG_PID");
  for (const char* wrong : {"", "0", "-5", "soon", "2s"}) {
    setenv("WATCHDOG_USEC", wrong, 1);
    EXPECT_FALSE(ServiceNotice::watchdog_period()) << wrong;
  }
  unsetenv("WATCHDOG_USEC");
}

}  // namespace
}  // namespace tactus::firmware
