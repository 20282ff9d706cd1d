#include "hal/linux/pwm_output.h"

#include "tests/unit/hal/linux/sysfs_folder.h"
#include "tests/unit/hal/pwm_output_contract.h"

namespace tactus::hal {
namespace {

void lay_out_channel(const SysfsFolder& folder) {
  folder.set("pwmchip0/export", "");
  folder.set("pwmchip0/pwm1/period", "0");
  folder.set("pwmchip0/pwm1/duty_cycle", "0");
  folder.set("pwmchip0/pwm1/enable", "0");
}

struct FolderPwmRig {
  FolderPwmRig() {
    lay_out_channel(folder);
    EXPECT_TRUE(channel.open("pwmchip0", 1, folder.root()));
  }
  PwmOutput& output() { return channel; }
  SysfsFolder folder;
  LinuxPwmOutput channel;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Sysfs, PwmOutputContract, FolderPwmRig);

TEST(LinuxPwmOutput, WritesWhatTheKernelReads) {
  FolderPwmRig rig;
  ASSERT_TRUE(rig.output().set_period_ns(50'000));
  ASSERT_TRUE(rig.output().set_enabled(true));
  ASSERT_TRUE(rig.output().set_duty_ns(12'500));
  EXPECT_EQ(rig.folder.get("pwmchip0/pwm1/period"), "50000");
  EXPECT_EQ(rig.folder.get("pwmchip0/pwm1/enable"), "1");
  EXPECT_EQ(rig.folder.get("pwmchip0/pwm1/duty_cycle"), "12500");
  ASSERT_TRUE(rig.output().set_duty_ns(7));
  EXPECT_EQ(rig.folder.get("pwmchip0/pwm1/duty_cycle"), "7");
}

TEST(LinuxPwmOutput, OpeningStopsWhatTheLastProgramLeftRunning) {
  const SysfsFolder folder;
  lay_out_channel(folder);
  folder.set("pwmchip0/pwm1/period", "50000");
  folder.set("pwmchip0/pwm1/duty_cycle", "50000");
  folder.set("pwmchip0/pwm1/enable", "1");
  LinuxPwmOutput channel;
  ASSERT_TRUE(channel.open("pwmchip0", 1, folder.root()));
  EXPECT_EQ(folder.get("pwmchip0/pwm1/duty_cycle"), "0");
  EXPECT_EQ(folder.get("pwmchip0/pwm1/enable"), "0");
}

TEST(LinuxPwmOutput, ClosingLeavesDutyZeroAndDisabled) {
  const SysfsFolder folder;
  lay_out_channel(folder);
  {
    LinuxPwmOutput channel;
    ASSERT_TRUE(channel.open("pwmchip0", 1, folder.root()));
    ASSERT_TRUE(channel.set_period_ns(50'000));
    ASSERT_TRUE(channel.set_enabled(true));
    ASSERT_TRUE(channel.set_duty_ns(20'000));
  }
  EXPECT_EQ(folder.get("pwmchip0/pwm1/duty_cycle"), "0");
  EXPECT_EQ(folder.get("pwmchip0/pwm1/enable"), "0");
}

TEST(LinuxPwmOutput, DisablesAnOutputThatWasEnabled) {
  FolderPwmRig rig;
  ASSERT_TRUE(rig.output().set_period_ns(50'000));
  ASSERT_TRUE(rig.output().set_enabled(true));
  ASSERT_TRUE(rig.output().set_enabled(false));
  EXPECT_EQ(rig.folder.get("pwmchip0/pwm1/enable"), "0");
}

TEST(LinuxPwmOutput, AChannelThatCannotBeSilencedIsNotOpened) {
  for (const char* const attribute : {"pwmchip0/pwm1/duty_cycle", "pwmchip0/pwm1/enable"}) {
    const SysfsFolder folder;
    lay_out_channel(folder);
    folder.set(attribute, "no number");
    LinuxPwmOutput channel;
    EXPECT_FALSE(channel.open("pwmchip0", 1, folder.root())) << attribute;
    folder.set(attribute, "0");
    EXPECT_TRUE(channel.open("pwmchip0", 1, folder.root())) << attribute;
  }
}

TEST(LinuxPwmOutput, ExportsAChannelThatIsNotThere) {
  const SysfsFolder folder;
  folder.set("pwmchip0/export", "");
  LinuxPwmOutput channel;
  const auto opened = channel.open("pwmchip0", 3, folder.root());
  EXPECT_EQ(folder.get("pwmchip0/export"), "3");
  ASSERT_FALSE(opened);  // an ordinary file makes no channel
  EXPECT_EQ(opened.error().code, ErrorCode::not_found);
}

TEST(LinuxPwmOutput, MissingChipIsNotFound) {
  const SysfsFolder folder;
  LinuxPwmOutput channel;
  const auto opened = channel.open("pwmchip7", 0, folder.root());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_found);
}

TEST(LinuxPwmOutput, OpensOnlyOnce) {
  FolderPwmRig rig;
  const auto again = rig.channel.open("pwmchip0", 1, rig.folder.root());
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::invalid_state);
}

TEST(SysfsFailure, TellsWhatACallerMayActUpon) {
  EXPECT_EQ(sysfs_failure(ENODEV).error().code, ErrorCode::disconnected);
  EXPECT_EQ(sysfs_failure(ENXIO).error().code, ErrorCode::disconnected);
  EXPECT_EQ(sysfs_failure(EINVAL).error().code, ErrorCode::not_supported);
  EXPECT_EQ(sysfs_failure(EBUSY).error().code, ErrorCode::busy);
  EXPECT_EQ(sysfs_failure(EACCES).error().code, ErrorCode::not_permitted);
  EXPECT_EQ(sysfs_failure(ENOMEM).error().code, ErrorCode::no_memory);
  EXPECT_EQ(sysfs_failure(EIO).error().code, ErrorCode::io);
  EXPECT_EQ(sysfs_failure(EIO).error().errno_value, EIO);
}

}  // namespace
}  // namespace tactus::hal
