#include "drivers/odrive_can/odrive_errors.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <span>
#include <string_view>

namespace tactus::drivers::odrive {
namespace {

// The bits of ODrive's own lists.
constexpr std::array<std::uint64_t, 12> kAxis{0x1,    0x40,   0x80,   0x100,   0x200,   0x800,
                                              0x1000, 0x2000, 0x4000, 0x20000, 0x40000, 0x80000};
constexpr std::array<std::uint64_t, 27> kMotor{
    0x1,        0x2,        0x8,         0x10,        0x80,        0x400,      0x1000,
    0x10000,    0x20000,    0x40000,     0x80000,     0x100000,    0x200000,   0x400000,
    0x800000,   0x1000000,  0x2000000,   0x4000000,   0x8000000,   0x10000000, 0x20000000,
    0x40000000, 0x80000000, 0x100000000, 0x200000000, 0x400000000, 0x800000000};
constexpr std::array<std::uint64_t, 10> kEncoder{0x1,  0x2,  0x4,  0x8,   0x10,
                                                 0x20, 0x40, 0x80, 0x100, 0x200};
constexpr std::array<std::uint64_t, 8> kController{0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80};
constexpr std::array<std::uint64_t, 22> kActive{
    0x1,       0x2,       0x4,       0x8,       0x10,       0x20,      0x40,   0x100,
    0x200,     0x400,     0x800,     0x1000,    0x2000,     0x4000,    0x8000, 0x10000,
    0x1000000, 0x2000000, 0x4000000, 0x8000000, 0x10000000, 0x40000000};

template <class Words>
void expect_every_bit_has_its_words(std::span<const std::uint64_t> bits, Words words) {
  std::set<std::string_view> seen;
  for (const std::uint64_t bit : bits) {
    const Trouble trouble = words(bit);
    ASSERT_TRUE(trouble) << std::hex << bit;
    EXPECT_FALSE(trouble.remedy.empty()) << std::hex << bit;
    EXPECT_TRUE(seen.insert(trouble.what).second) << trouble.what;
    EXPECT_EQ(trouble.code, static_cast<std::uint32_t>(bit >> 32U != 0 ? bit >> 32U : bit));
    EXPECT_EQ(trouble.what.find("this program"), std::string_view::npos) << trouble.what;
  }
}

template <auto kFunction>
Trouble narrow(std::uint64_t bit) {
  return kFunction(static_cast<std::uint32_t>(bit));
}

TEST(ODriveErrors, EveryBitOfEitherGenerationHasWordsOfItsOwn) {
  expect_every_bit_has_its_words(kAxis, narrow<axis_trouble>);
  expect_every_bit_has_its_words(kMotor, motor_trouble);
  expect_every_bit_has_its_words(kEncoder, narrow<encoder_trouble>);
  expect_every_bit_has_its_words(kController, narrow<controller_trouble>);
  expect_every_bit_has_its_words(kActive, narrow<active_trouble>);
}

TEST(ODriveErrors, UnknownBitStillHasARemedyAndItsCode) {
  const Trouble trouble = active_trouble(0x80);
  EXPECT_NE(trouble.what.find("this program"), std::string_view::npos);
  EXPECT_FALSE(trouble.remedy.empty());
  EXPECT_EQ(trouble.code, 0x80U);
}

TEST(ODriveErrors, TellingErrorComesBeforeItsConsequences) {
  EXPECT_EQ(axis_trouble(0x1 | 0x40 | 0x800).what, axis_trouble(0x800).what);
  EXPECT_EQ(motor_trouble(0x20'0000 | 0x8).what, motor_trouble(0x8).what);
  EXPECT_TRUE(is_explained_elsewhere(0x40 | 0x1));
  EXPECT_FALSE(is_explained_elsewhere(0x40 | 0x800));
  EXPECT_FALSE(is_explained_elsewhere(0x1));
}

TEST(ODriveErrors, EveryRefusalOfAProcedureHasWords) {
  EXPECT_FALSE(procedure_trouble(0));
  EXPECT_FALSE(procedure_trouble(1));
  std::set<std::string_view> seen;
  for (std::uint8_t result = 2; result <= 16; ++result) {
    EXPECT_TRUE(seen.insert(procedure_trouble(result).what).second) << int{result};
    EXPECT_EQ(procedure_trouble(result).code, result);
  }
}

}  // namespace
}  // namespace tactus::drivers::odrive
