#include "rendering/geometry/floats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tactus::rendering {
namespace {

TEST(Floats, WhichTellsEveryAnswerByItsBit) {
  for (std::uint32_t bits = 0; bits < 16; ++bits) {
    Integers answers{};
    for (std::uint32_t k = 0; k < 4; ++k) {
      answers[k] = ((bits >> k) & 1U) != 0 ? -1 : 0;
    }
    EXPECT_EQ(which(answers), bits);
  }
}

TEST(Floats, AMagnitudeIsWithoutSign) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Floats magnitudes = magnitude(Floats{-1.5F, 2.5F, -0.0F, -kInfinity});
  EXPECT_EQ(magnitudes[0], 1.5F);
  EXPECT_EQ(magnitudes[1], 2.5F);
  EXPECT_FALSE(std::signbit(magnitudes[2]));
  EXPECT_EQ(magnitudes[3], kInfinity);
}

}  // namespace
}  // namespace tactus::rendering
