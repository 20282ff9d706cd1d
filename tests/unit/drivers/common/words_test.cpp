#include "drivers/common/words.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

TEST(Words, NumbersAreRoundedAndLoseTheirLastZeros) {
  Words words;
  words.add(0.5236, 3).add(" ").add(-0.0625, 4).add(" ").add(12.0).add(" ").add(0.9996).add(" ");
  words.add(-0.0001).add(" ").add(146.4, 0).add(" ").add(0x181U, 16U).add(" ").add(1e300);
  EXPECT_EQ(words.view(), "0.524 -0.0625 12 1 0 146 181 more than 1e9");
}

TEST(Words, WhatDoesNotFitIsLeftOut) {
  Words words;
  for (int i = 0; i < 100; ++i) {
    words.add("twelve bytes");
  }
  EXPECT_EQ(words.view().size(), 640U);
}

}  // namespace
}  // namespace tactus::drivers
