// Frames against published ones: a log of a VESC with id 4 that a user posted (vesc-project.com,
// node 3345), and those that PROTOCOLS.md computed with the firmware's own code.
#include "drivers/vesc_can/vesc_protocol.h"

#include <gtest/gtest.h>

#include "drivers/vesc_can/vesc_faults.h"
#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::vesc {
namespace {

TEST(VescProtocol, CurrentIsInMilliAmperesBigEndian) {
  EXPECT_EQ(text_of(held_current_frame(0x17, 51'000, 0)), "00000117#0000C7380000");
  EXPECT_EQ(text_of(held_current_frame(0x17, -1'500, 100)), "00000117#FFFFFA240064");
  EXPECT_EQ(text_of(release_frame(0x17)), "00000117#00000000");
}

TEST(VescProtocol, StatusIsReadAsTheFirmwareWritesIt) {
  const auto status = status_of(frame_of("00000917#FFFFFB50 FFDD 007B"), 0x17);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->erpm, -1200);
  EXPECT_NEAR(status->current_A, -3.5, 1e-12);
  EXPECT_NEAR(status->duty, 0.123, 1e-12);
}

TEST(VescProtocol, PostedLogIsReadAsItsVescStood) {
  const auto status = status_of(frame_of("00000904#0000000000000029"), 4);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->erpm, 0);
  EXPECT_NEAR(status->duty, 0.041, 1e-12);
  const auto status_4 = status_4_of(frame_of("00001004#00FDFE840000251E"), 4);
  ASSERT_TRUE(status_4);
  EXPECT_NEAR(status_4->fet_C, 25.3, 1e-12);
  EXPECT_NEAR(status_4->motor_C, -38.0, 1e-12);  // no sensor
  EXPECT_NEAR(status_4->input_A, 0.0, 1e-12);
  EXPECT_NEAR(status_4->position_deg, 190.04, 1e-12);
  const auto status_5 = status_5_of(frame_of("00001B04#0000000C00EF0000"), 4);
  ASSERT_TRUE(status_5);
  EXPECT_EQ(status_5->tachometer, 12);
  EXPECT_NEAR(status_5->input_V, 23.9, 1e-12);
}

TEST(VescProtocol, QuestionAndAnswerFitIntoOneFrameEach) {
  EXPECT_EQ(text_of(query_frame(0x17, 0xFD, Query::fault)), "00000817#FD003200008000");
  EXPECT_EQ(text_of(query_frame(0x17, 0xFD, Query::flags)), "00000817#FD003200200000");
  const auto fault = answer_of(frame_of("000008FD#17013200008000 04"), 0x17, 0xFD);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->query, Query::fault);
  EXPECT_EQ(fault->value, 4);
  const auto flags = answer_of(frame_of("000008FD#17013200200000 02"), 0x17, 0xFD);
  ASSERT_TRUE(flags);
  EXPECT_EQ(flags->query, Query::flags);
  EXPECT_EQ(flags->value, kKillSwitch);
}

TEST(VescProtocol, WhatIsNotForThisVescOrMalformedIsNothing) {
  EXPECT_FALSE(status_of(frame_of("00000918#FFFFFB50FFDD007B"), 0x17));
  EXPECT_FALSE(status_of(frame_of("00000917#FFFFFB50FFDD00"), 0x17));
  EXPECT_FALSE(status_of(frame_of("117#FFFFFB50FFDD007B"), 0x17));
  EXPECT_FALSE(status_4_of(frame_of("00000917#FFFFFB50FFDD007B"), 0x17));
  EXPECT_FALSE(status_5_of(frame_of("00001017#FFFFFB50FFDD007B"), 0x17));
  EXPECT_FALSE(answer_of(frame_of("000008FD#1801320000800004"), 0x17, 0xFD));
  EXPECT_FALSE(answer_of(frame_of("000008FD#1701320000C00004"), 0x17, 0xFD));
  EXPECT_FALSE(answer_of(frame_of("000008FD#1701040000800004"), 0x17, 0xFD));
  EXPECT_FALSE(answer_of(frame_of("000008FD#17013200008000"), 0x17, 0xFD));
}

TEST(VescFaults, EveryCodeSaysWhatAndWhatToDo) {
  EXPECT_FALSE(fault_trouble(0));
  for (std::uint32_t code = 1; code < 256; ++code) {
    const Trouble trouble = fault_trouble(static_cast<std::uint8_t>(code));
    EXPECT_TRUE(trouble);
    EXPECT_FALSE(trouble.remedy.empty());
    EXPECT_EQ(trouble.code, code);
  }
}

// Places in the list that the fact sheet gives.
TEST(VescFaults, CodesStandWhereTheFirmwareHasThem) {
  const auto says = [](std::uint8_t code, std::string_view words) {
    return fault_trouble(code).what.find(words) != std::string_view::npos;
  };
  EXPECT_TRUE(says(1, "too high a supply voltage"));
  EXPECT_TRUE(says(2, "too low a supply voltage"));
  EXPECT_TRUE(says(3, "DRV"));
  EXPECT_TRUE(says(4, "absolute over-current"));
  EXPECT_TRUE(says(6, "motor is too hot"));
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(fault_trouble(static_cast<std::uint8_t>(code)).is_heat, code == 5 || code == 6);
  }
  EXPECT_TRUE(says(11, "SPI"));
  EXPECT_TRUE(says(14, "flash"));
  EXPECT_TRUE(says(18, "unbalanced"));
  EXPECT_TRUE(says(19, "BRK"));
  EXPECT_TRUE(says(22, "resolver"));
  EXPECT_TRUE(says(24, "motor settings"));
  EXPECT_TRUE(says(27, "phase filter"));
  EXPECT_TRUE(says(28, "fault of the encoder"));
  EXPECT_TRUE(says(30, "slips"));
  EXPECT_TRUE(says(33, "over-speed"));
  EXPECT_TRUE(says(34, "does not know"));
}

}  // namespace
}  // namespace tactus::drivers::vesc
