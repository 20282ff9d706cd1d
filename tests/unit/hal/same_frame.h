#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "hal/can_frame.h"

namespace tactus::hal {

// Expects two CAN frames to be equal in every field and in the bytes that their length covers.
inline void expect_same(const CanFrame& left, const CanFrame& right) {
  EXPECT_EQ(left.id, right.id);
  EXPECT_EQ(left.extended, right.extended);
  EXPECT_EQ(left.remote, right.remote);
  EXPECT_EQ(left.fd, right.fd);
  EXPECT_EQ(left.bit_rate_switch, right.bit_rate_switch);
  EXPECT_EQ(left.length, right.length);
  EXPECT_TRUE(std::ranges::equal(left.bytes(), right.bytes()));
}

}  // namespace tactus::hal
