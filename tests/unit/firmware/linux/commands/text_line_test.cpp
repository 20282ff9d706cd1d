#include "firmware/linux/commands/text_line.h"

#include <gtest/gtest.h>

#include <string>

namespace tactus::firmware {
namespace {

TEST(TextLine, NumbersReadBackToTheSameValue) {
  TextLine line;
  line.add("a=").add(0.1).add(" b=").add(std::uint64_t{18446744073709551615U}).end();
  EXPECT_EQ(line.text(), "a=0.1 b=18446744073709551615\n");
}

TEST(TextLine, WhatDoesNotFitIsLeftOffAndSaidSo) {
  TextLine line;
  line.add(std::string(600, 'x')).end();
  EXPECT_EQ(line.text().size(), TextLine::kRoom);
  EXPECT_TRUE(line.text().ends_with("x...\n"));
}

TEST(TextLine, StaysOneLineThatATerminalCanShow) {
  TextLine line;
  line.add("a\nb\r\x1b[2J").end();
  EXPECT_EQ(line.text(), "a?b??[2J\n");
}

}  // namespace
}  // namespace tactus::firmware
