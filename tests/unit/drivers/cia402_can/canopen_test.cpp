// Frames against published examples: a Festo manual on CiA 402 (GDCP-CMMS/D-C-CO, 1404NH, page 20:
// reading and writing parameters), an EAO keypad's boot sequence (09 series, page 51), the bytes of
// PROTOCOLS.md that python-canopen and CANopenNode agree on.
#include "drivers/cia402_can/canopen.h"

#include <gtest/gtest.h>

#include "drivers/cia402_can/sdo.h"
#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::canopen {
namespace {

constexpr std::uint8_t kKeypad = 0x0B;

TEST(CanOpen, NetworkManagementFramesAreThePublishedOnes) {
  EXPECT_EQ(text_of(nmt_frame(NmtCommand::start, kKeypad)), "000#010B");
  EXPECT_EQ(text_of(nmt_frame(NmtCommand::stop, 0x15)), "000#0215");
  EXPECT_EQ(text_of(nmt_frame(NmtCommand::enter_pre_operational, 1)), "000#8001");
  EXPECT_EQ(text_of(nmt_frame(NmtCommand::reset_node, 1)), "000#8101");
  EXPECT_EQ(text_of(nmt_frame(NmtCommand::reset_communication, 127)), "000#827F");
  EXPECT_EQ(text_of(sync_frame()), "080#");
}

TEST(CanOpen, HeartbeatsAreReadAsPublished) {
  EXPECT_EQ(heartbeat_of(frame_of("70B#00"), kKeypad), NmtState::boot_up);
  EXPECT_EQ(heartbeat_of(frame_of("70B#7F"), kKeypad), NmtState::pre_operational);
  EXPECT_EQ(heartbeat_of(frame_of("70B#05"), kKeypad), NmtState::operational);
  EXPECT_EQ(heartbeat_of(frame_of("70B#04"), kKeypad), NmtState::stopped);
  EXPECT_EQ(text_of(heartbeat_frame(0x7F, NmtState::operational)), "77F#05");
}

TEST(CanOpen, HeartbeatsOfOthersAndMalformedOnesAreNone) {
  EXPECT_FALSE(heartbeat_of(frame_of("70C#05"), kKeypad));
  EXPECT_FALSE(heartbeat_of(frame_of("70B#"), kKeypad));
  EXPECT_FALSE(heartbeat_of(frame_of("70B#0505"), kKeypad));
  EXPECT_FALSE(heartbeat_of(frame_of("70B#R"), kKeypad));
  EXPECT_FALSE(heartbeat_of(frame_of("0000070B#05"), kKeypad));
  EXPECT_FALSE(heartbeat_of(frame_of("70B##005"), kKeypad));
}

TEST(CanOpen, EmergencyIsCodeRegisterAndFiveBytesOfTheMaker) {
  const auto emergency = emergency_of(frame_of("085#3081 11 0102030405"), 5);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(emergency->code, 0x8130);
  EXPECT_EQ(emergency->error_register, 0x11);
  EXPECT_EQ(emergency->vendor, (std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}));
  EXPECT_FALSE(emergency_of(frame_of("085#30811101020304"), 5));
  EXPECT_FALSE(emergency_of(frame_of("080#"), 0));
}

// Festo's frames without the identifier, which there is "the SDO's"; node 1 here.
TEST(Sdo, QuestionsAreThePublishedOnes) {
  EXPECT_EQ(text_of(sdo_read(1, {0x6061, 0})), "601#4061600000000000");
  EXPECT_EQ(text_of(sdo_read(1, {0x6041, 0})), "601#4041600000000000");
  EXPECT_EQ(text_of(sdo_write(1, {0x1401, 2}, 0xEF, 1)), "601#2F011402EF000000");
  EXPECT_EQ(text_of(sdo_write(1, {0x6040, 0}, 0x03E8, 2)), "601#2B406000E8030000");
  EXPECT_EQ(text_of(sdo_write(1, {0x6093, 1}, 0x12345678, 4)), "601#2393600178563412");
}

// A published trace of setting a drive's watchdog: node 2 waits 300 ms for node 127.
TEST(Sdo, WatchdogOnTheHostIsThePublishedWrite) {
  EXPECT_EQ(text_of(sdo_write(2, {0x1016, 1}, 0x007F'012C, 4)), "602#231610012C017F00");
  const auto answer = sdo_answer_of(frame_of("582#6016100100000000"), 2);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->kind, SdoAnswer::Kind::written);
  EXPECT_EQ(answer->object, (ObjectAddress{0x1016, 1}));
}

TEST(Sdo, AnswersAreReadAsPublished) {
  const auto one_byte = sdo_answer_of(frame_of("581#4F61600001000000"), 1);
  ASSERT_TRUE(one_byte);
  EXPECT_EQ(one_byte->kind, SdoAnswer::Kind::value);
  EXPECT_EQ(one_byte->value, 1U);
  EXPECT_EQ(one_byte->size, 1);
  const auto two_bytes = sdo_answer_of(frame_of("581#4B41600034120000"), 1);
  ASSERT_TRUE(two_bytes);
  EXPECT_EQ(two_bytes->object, (ObjectAddress{0x6041, 0}));
  EXPECT_EQ(two_bytes->value, 0x1234U);
  const auto four_bytes = sdo_answer_of(frame_of("581#4393600178563412"), 1);
  ASSERT_TRUE(four_bytes);
  EXPECT_EQ(four_bytes->object, (ObjectAddress{0x6093, 1}));
  EXPECT_EQ(four_bytes->value, 0x12345678U);
  EXPECT_EQ(four_bytes->size, 4);
}

TEST(Sdo, BytesBeyondTheSizeAreNotPartOfTheValue) {
  EXPECT_EQ(sdo_answer_of(frame_of("581#4F616000 01FFFFFF"), 1)->value, 1U);
  EXPECT_EQ(sdo_answer_of(frame_of("581#47616000 01FFFFFF"), 1)->value, 0xFFFF01U);
}

TEST(Sdo, AbortHasTheObjectAndTheCode) {
  const auto abort = sdo_answer_of(frame_of("581#80726000 30000906"), 1);
  ASSERT_TRUE(abort);
  EXPECT_EQ(abort->kind, SdoAnswer::Kind::abort);
  EXPECT_EQ(abort->object, (ObjectAddress{0x6072, 0}));
  EXPECT_EQ(abort->value, 0x0609'0030U);
  EXPECT_NE(sdo_abort_words(abort->value).find("out of range"), std::string_view::npos);
  EXPECT_EQ(text_of(sdo_abort(1, {0x1008, 0}, kAbortBadCommand)), "601#8008100001000405");
}

TEST(Sdo, EveryAbortCodeHasWords) {
  for (const std::uint32_t code :
       {0x05030000U, 0x05040000U, 0x05040001U, 0x06010000U, 0x06010001U, 0x06010002U,
        0x06020000U, 0x06040041U, 0x06040042U, 0x06040043U, 0x06060000U, 0x06070010U,
        0x06070012U, 0x06070013U, 0x06090011U, 0x06090030U, 0x06090031U, 0x06090032U,
        0x08000000U, 0x08000020U, 0x08000021U, 0x08000022U}) {
    EXPECT_NE(sdo_abort_words(code), sdo_abort_words(0)) << std::hex << code;
  }
  EXPECT_FALSE(sdo_abort_words(0x12345678).empty());
}

TEST(Sdo, SegmentedAndMalformedAnswersAreToldApart) {
  EXPECT_EQ(sdo_answer_of(frame_of("581#4108100010000000"), 1)->kind, SdoAnswer::Kind::segmented);
  EXPECT_EQ(sdo_answer_of(frame_of("581#00081000"), 1)->kind, SdoAnswer::Kind::malformed);
  EXPECT_EQ(sdo_answer_of(frame_of("581#E008100010000000"), 1)->kind, SdoAnswer::Kind::malformed);
  EXPECT_FALSE(sdo_answer_of(frame_of("582#4F61600001000000"), 1));
}

}  // namespace
}  // namespace tactus::drivers::canopen
