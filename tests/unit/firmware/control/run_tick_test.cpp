#include "firmware/control/run_tick.h"

#include <gtest/gtest.h>

#include <string>

#include "firmware/safety/faults.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

// A device that writes down its calls.
class LoggedDevice {
 public:
  static std::size_t joint_count() { return kJointCount; }

  void read(drivers::JointSample& sample) {
    calls += "read ";
    sample = next;
  }

  std::uint32_t write(const drivers::JointCommand& command) {
    calls += "write ";
    written = command;
    return write_status;
  }

  void clear_faults() { calls += "clear_faults "; }

  std::string calls;
  drivers::JointSample next;
  drivers::JointCommand written;
  std::uint32_t write_status = drivers::kDeviceOk;
};
static_assert(drivers::Device<LoggedDevice>);

std::uint64_t g_clock_ns = 0;
std::uint64_t clock_by_sevens() {
  return g_clock_ns += 7;
}

class RunTick : public ::testing::Test {
 protected:
  RunTick() { EXPECT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config()))); }

  std::string calls_of(Request request) {
    device_.calls.clear();
    run_tick(controller_, device_, request);
    return device_.calls;
  }

  Controller controller_;
  LoggedDevice device_;
};

TEST_F(RunTick, ReadsThenWritesOnce) {
  EXPECT_EQ(calls_of(Request::none), "read write ");
}

TEST_F(RunTick, WritesTheCommandOfThisVeryTick) {
  run_tick(controller_, device_, Request::home);
  run_tick(controller_, device_, Request::none);
  run_tick(controller_, device_, Request::enable);
  EXPECT_TRUE(device_.written.enable);
  device_.next.status = drivers::kDeviceDriveFault;
  run_tick(controller_, device_, Request::none);
  EXPECT_FALSE(device_.written.enable);
}

TEST_F(RunTick, AFailedWriteIsAFaultOneTickLater) {
  device_.write_status = drivers::kDeviceLost;
  run_tick(controller_, device_, Request::none);
  EXPECT_EQ(controller_.record().faults, 0U);
  run_tick(controller_, device_, Request::none);
  EXPECT_EQ(controller_.record().faults, kFaultDeviceLost);
}

TEST_F(RunTick, OnlyAResetOfAFaultClearsTheDevice) {
  EXPECT_EQ(calls_of(Request::reset), "read write ");
  run_tick(controller_, device_, Request::estop);
  EXPECT_EQ(calls_of(Request::none), "read write ");
  EXPECT_EQ(calls_of(Request::reset), "clear_faults read write ");
  EXPECT_EQ(controller_.mode(), Mode::init);
}

TEST_F(RunTick, TransferTimesGoIntoTheRecord) {
  controller_.set_clock(clock_by_sevens);
  run_tick(controller_, device_, Request::none);
  EXPECT_EQ(controller_.record().stage_ns.read, 7U);
  EXPECT_EQ(controller_.record().stage_ns.write, 7U);
}

}  // namespace
}  // namespace tactus::firmware
