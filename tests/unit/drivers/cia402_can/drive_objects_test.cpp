#include "drivers/cia402_can/drive_objects.h"

#include <gtest/gtest.h>

#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::cia402 {
namespace {

constexpr hal::TimeNs kPastTheTimeout_ns = 1'000'000'000;

class DriveObjectsTest : public ::testing::Test {
 protected:
  DriveObjects::Progress set_up(hal::TimeNs now_ns) {
    outbox_.clear();
    return objects_.set_up(config_, now_ns, outbox_);
  }

  Cia402Config config_{.node = 3, .max_torque_Nm = 0.1};
  DriveObjects objects_{config_};
  CanOutbox outbox_;
};

TEST_F(DriveObjectsTest, TheSetUpAsksForOneObjectAfterTheOther) {
  EXPECT_FALSE(set_up(0).value());
  ASSERT_EQ(outbox_.frames().size(), 1U);
  EXPECT_EQ(text_of(outbox_.frames()[0]), "603#4000100000000000");  // the device's type
  objects_.take(frame_of("583#4300100092010200"));
  EXPECT_FALSE(set_up(1).value());
  ASSERT_EQ(outbox_.frames().size(), 1U);
  EXPECT_NE(text_of(outbox_.frames()[0]), "603#4000100000000000");
}

TEST_F(DriveObjectsTest, AnotherProfileIsRefused) {
  EXPECT_FALSE(set_up(0).value());
  objects_.take(frame_of("583#4300100091010200"));
  const auto progress = set_up(1);
  ASSERT_FALSE(progress);
  EXPECT_EQ(progress.error().status, kDeviceDriveFault);
  EXPECT_TRUE(progress.error().trouble);
}

TEST_F(DriveObjectsTest, ASilentDriveIsLost) {
  EXPECT_FALSE(set_up(0).value());
  EXPECT_FALSE(set_up(kPastTheTimeout_ns).value());
  const auto progress = set_up(2 * kPastTheTimeout_ns);
  ASSERT_FALSE(progress);
  EXPECT_EQ(progress.error().status, kDeviceLost);
}

TEST_F(DriveObjectsTest, ASetUpThatBeginsAgainBeginsWithTheFirstObject) {
  EXPECT_FALSE(set_up(0).value());
  objects_.take(frame_of("583#4300100092010200"));
  EXPECT_FALSE(set_up(1).value());
  objects_.begin_set_up();
  EXPECT_FALSE(set_up(2).value());
  EXPECT_EQ(text_of(outbox_.frames()[0]), "603#4000100000000000");
}

TEST_F(DriveObjectsTest, AnObjectIsReadOnceItsAnswerIsThereAndAskedForAgain) {
  EXPECT_FALSE(objects_.read({0x6041, 0}, 0, outbox_));
  EXPECT_TRUE(objects_.is_asking());
  objects_.take(frame_of("583#4B41600037020000"));
  EXPECT_EQ(objects_.read({0x6041, 0}, 1, outbox_), 0x0237U);
  EXPECT_FALSE(objects_.is_asking());
  outbox_.clear();
  EXPECT_FALSE(objects_.read({0x6041, 0}, 2, outbox_));
  EXPECT_EQ(outbox_.frames().size(), 1U);
}

TEST_F(DriveObjectsTest, ARefusedObjectHasNoValue) {
  EXPECT_FALSE(objects_.read({0x6041, 0}, 0, outbox_));
  objects_.take(frame_of("583#8041600000000206"));
  EXPECT_FALSE(objects_.read({0x6041, 0}, 1, outbox_));
  EXPECT_FALSE(objects_.is_asking());
}

TEST_F(DriveObjectsTest, TorqueModeIsSetOnceTheDriveHasTakenIt) {
  EXPECT_FALSE(objects_.choose_torque_mode(config_, 0, outbox_).value());
  EXPECT_FALSE(objects_.mode_is_set());
  objects_.take(frame_of("583#6060600000000000"));
  EXPECT_TRUE(objects_.choose_torque_mode(config_, 1, outbox_).value());
  EXPECT_TRUE(objects_.mode_is_set());
  objects_.restart();
  EXPECT_FALSE(objects_.mode_is_set());
}

}  // namespace
}  // namespace tactus::drivers::cia402
