// Statuswords and controlwords against the table of the profile's states, and against words that
// drives on the market are seen to send.
#include "drivers/cia402_can/drive_profile.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "drivers/cia402_can/error_codes.h"
#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::cia402 {
namespace {

using enum PowerState;

TEST(DriveProfile, StatuswordsOfRealDrivesGiveTheirState) {
  const std::vector<std::pair<std::uint16_t, PowerState>> seen = {{0x0250, switch_on_disabled},
                                                                  {0x0240, switch_on_disabled},
                                                                  {0x0231, ready_to_switch_on},
                                                                  {0x0233, switched_on},
                                                                  {0x0237, operation_enabled},
                                                                  {0x1237, operation_enabled},
                                                                  {0x1637, operation_enabled},
                                                                  {0x0217, quick_stop_active},
                                                                  {0x0218, fault},
                                                                  {0x0208, fault},
                                                                  {0x021F, fault_reaction_active}};
  for (const auto& [word, state] : seen) {
    EXPECT_EQ(power_state(word), state) << std::hex << word;
  }
}

// The masks leave no statusword with two states; a few patterns have none.
TEST(DriveProfile, EveryStatuswordHasAtMostOneState) {
  const std::map<PowerState, std::pair<std::uint16_t, std::uint16_t>> table = {
      {not_ready_to_switch_on, {0x4F, 0x00}}, {switch_on_disabled, {0x4F, 0x40}},
      {ready_to_switch_on, {0x6F, 0x21}},     {switched_on, {0x6F, 0x23}},
      {operation_enabled, {0x6F, 0x27}},      {quick_stop_active, {0x6F, 0x07}},
      {fault_reaction_active, {0x4F, 0x0F}},  {fault, {0x4F, 0x08}}};
  for (std::uint32_t word = 0; word <= 0xFFFF; ++word) {
    PowerState expected = unknown;
    int matches = 0;
    for (const auto& [state, pattern] : table) {
      if ((word & pattern.first) == pattern.second) {
        expected = state;
        ++matches;
      }
    }
    ASSERT_LE(matches, 1);
    ASSERT_EQ(power_state(static_cast<std::uint16_t>(word)), expected);
  }
}

TEST(DriveProfile, WayToTorqueIsShutdownSwitchOnEnableOperation) {
  EXPECT_EQ(controlword_toward(switch_on_disabled, true), 0x06);
  EXPECT_EQ(controlword_toward(ready_to_switch_on, true), 0x07);
  EXPECT_EQ(controlword_toward(switched_on, true), 0x0F);
  EXPECT_EQ(controlword_toward(operation_enabled, true), 0x0F);
}

TEST(DriveProfile, WithoutPowerNoControlwordSwitchesOn) {
  for (const PowerState state :
       {not_ready_to_switch_on, switch_on_disabled, ready_to_switch_on, switched_on,
        operation_enabled, quick_stop_active, fault_reaction_active, fault, unknown}) {
    const std::uint16_t word = controlword_toward(state, false);
    EXPECT_TRUE(word == 0x00 || word == 0x06) << static_cast<int>(state);
    EXPECT_FALSE(power_state_words(state).empty());
  }
  for (const PowerState state : {quick_stop_active, fault_reaction_active, fault, unknown}) {
    EXPECT_EQ(controlword_toward(state, true), 0x00);
  }
}

TEST(DriveProfile, CommandIsControlwordAndTorque) {
  EXPECT_EQ(text_of(command_frame(1, {kEnableOperation, 500})), "201#0F00F401");
  EXPECT_EQ(text_of(command_frame(127, {kFaultReset, -1})), "27F#8000FFFF");
}

TEST(DriveProfile, StateIsStatuswordPositionAndTorque) {
  const auto state = drive_state_of(frame_of("181#3712 FEFFFFFF 0CFE"), 1);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->statusword, 0x1237);
  EXPECT_EQ(state->position, -2);
  EXPECT_EQ(state->torque, -500);
  EXPECT_FALSE(drive_state_of(frame_of("182#3712FEFFFFFF0CFE"), 1));
  EXPECT_FALSE(drive_state_of(frame_of("181#3712FEFFFFFF0C"), 1));
}

TEST(DriveProfile, MotionIsVelocityAndMode) {
  const auto motion = drive_motion_of(frame_of("281#18FCFFFF 0A"), 1);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->velocity, -1000);
  EXPECT_EQ(motion->mode, 10);
  EXPECT_FALSE(drive_motion_of(frame_of("281#18FCFFFF0A00"), 1));
}

TEST(DriveErrors, EveryCodeSaysWhatAndWhatToDo) {
  for (std::uint32_t code = 1; code <= 0xFFFF; ++code) {
    const Trouble trouble = error_code_trouble(static_cast<std::uint16_t>(code));
    ASSERT_TRUE(trouble) << std::hex << code;
    ASSERT_FALSE(trouble.remedy.empty());
    ASSERT_EQ(trouble.code, code);
  }
}

TEST(DriveErrors, KnownCodesAreToldBeforeTheirClass) {
  EXPECT_NE(error_code_trouble(0x8130).what.find("heartbeat"), std::string_view::npos);
  EXPECT_NE(error_code_trouble(0x3220).what.find("too low a voltage"), std::string_view::npos);
  EXPECT_NE(error_code_trouble(0x2340).what.find("current"), std::string_view::npos);
  EXPECT_NE(error_code_trouble(0x7380).what.find("encoder"), std::string_view::npos);
  EXPECT_NE(error_code_trouble(0x8611).what.find("lost control"), std::string_view::npos);
}

}  // namespace
}  // namespace tactus::drivers::cia402
