#include "firmware/bare_metal/session.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

// A device at rest, which loses itself when it is told to.
struct RestingDevice {
  static std::size_t joint_count() { return kJointCount; }
  void read(drivers::JointSample& sample) const {
    sample = {};
    sample.status = status;
  }
  static std::uint32_t write(const drivers::JointCommand& /*command*/) {
    return drivers::kDeviceOk;
  }
  static void clear_faults() {}

  std::uint32_t status = drivers::kDeviceOk;
};

TEST(BareMetalSession, BringsADeviceToForceAndLeavesAFaultToAPerson) {
  EXPECT_EQ(request_toward_active(Mode::init), Request::home);
  EXPECT_EQ(request_toward_active(Mode::homing), Request::none);
  EXPECT_EQ(request_toward_active(Mode::ready), Request::enable);
  EXPECT_EQ(request_toward_active(Mode::active), Request::none);
  EXPECT_EQ(request_toward_active(Mode::fault), Request::none);
}

TEST(BareMetalSession, LinesCountTicksFromOne) {
  TelemetryRecord record;
  record.tick = 998;
  EXPECT_FALSE(is_line_due(record));
  record.tick = 999;
  EXPECT_TRUE(is_line_due(record));
  record.mode = Mode::active;
  record.contact = rendering::ContactKind::vertex;
  record.state_hash = 0xfeed;
  record.counters.touch_flagged = 3;
  EXPECT_EQ(tick_line(record).text(),
            "tick 1000 hash 000000000000feed mode active touch vertex flagged 3");
}

TEST(BareMetalSession, AFaultHasItsCodeItsNameAndItsJoint) {
  TelemetryRecord record;
  record.tick = 3499;
  EXPECT_EQ(fault_line(record, kFaultJointNotFinite).text(), "fault 1 joint_not_finite tick 3500");
  record.fault_joint = 2;
  EXPECT_EQ(fault_line(record, kFaultJointLimit).text(), "fault 2 joint_limit tick 3500 joint 2");
}

TEST(BareMetalSession, ImagesWithoutAHeaderHaveNoChecksum) {
  EXPECT_EQ(image_line({}, {}).text(), "device 0000000000000000, scene 0000000000000000");
}

TEST(BareMetalSession, TellsAFaultOnceAndGoesOn) {
  Controller controller;
  ASSERT_TRUE(controller.configure(testing::without_sign_check(cartesian_config())));
  RestingDevice device;
  Session session(controller, device);
  std::vector<std::string> lines;
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      session.tick(0, [&](const Line& line) { lines.emplace_back(line.text()); });
    }
  };
  run(500);
  ASSERT_EQ(controller.mode(), Mode::active);
  EXPECT_TRUE(lines.empty());
  device.status = drivers::kDeviceLost;
  run(500);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].substr(0, lines[0].find(" tick")), "fault 7 device_lost");
  EXPECT_EQ(lines[1].substr(0, 15), "tick 1000 hash ");
  EXPECT_NE(lines[1].find(" mode fault "), std::string::npos);
}

}  // namespace
}  // namespace tactus::firmware
